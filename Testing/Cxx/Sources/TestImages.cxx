// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Images of real flows against baselines. No renderer is used: the intensities become grey levels.
#include "Fixtures.h"

#include "vtkDataSetSurfaceFilter.h"
#include "vtkExtractGrid.h"
#include "vtkImageShiftScale.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiBlockPLOT3DReader.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkPolyData.h"
#include "vtkReflectionFilter.h"
#include "vtkXMLImageDataReader.h"

#include <fstream>

namespace
{

const std::string data = SCHLIEREN_TEST_DATA;

/// Compares the intensities, of which `white` is white, with a baseline, grey level by grey level.
/// (vtkTesting::RegressionTest lets images pass that are shifted by a pixel, or that differ by less
/// than 16 levels: even a faint image turned upside down.)
void expectBaseline(vtkSchlierenFilter* filter, double white, const std::string& name)
{
  ASSERT_FALSE(isEmpty(filter));
  vtkNew<vtkImageShiftScale> grey;
  grey->SetInputConnection(filter->GetOutputPort());
  grey->SetScale(255 / white);
  grey->SetOutputScalarTypeToUnsignedChar();
  grey->ClampOverflowOn();
  grey->Update();

  const std::string made = std::string(SCHLIEREN_TEST_OUTPUT) + "/" + name + ".png";
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(made.c_str());
  writer->SetInputConnection(grey->GetOutputPort());
  writer->Write();

  const std::string kept = std::string(SCHLIEREN_TEST_BASELINE) + "/" + name + ".png";
  ASSERT_TRUE(std::ifstream(kept).good()) << "There is no baseline " << kept << " for " << made;
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(kept.c_str());
  reader->Update();
  vtkDataArray* actual = grey->GetOutput()->GetPointData()->GetScalars();
  vtkDataArray* expected = reader->GetOutput()->GetPointData()->GetScalars();
  ASSERT_TRUE(std::equal(grey->GetOutput()->GetDimensions(), grey->GetOutput()->GetDimensions() + 3,
    reader->GetOutput()->GetDimensions()));
  double sum = 0, most = 0;
  for (vtkIdType i = 0; i < actual->GetNumberOfTuples(); ++i)
  {
    const double difference = std::abs(actual->GetComponent(i, 0) - expected->GetComponent(i, 0));
    sum += difference;
    most = std::max(most, difference);
  }
  // Another compiler may round a level up where this one rounds it down.
  const double mean = sum / static_cast<double>(actual->GetNumberOfTuples());
  EXPECT_LT(mean, 0.05) << made;
  EXPECT_LE(most, 8) << made;
}

vtkSmartPointer<vtkSchlierenFilter> jet()
{
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName((data + "/ladenburg_jet_3d.vti").c_str());
  reader->Update();
  auto filter = vtkSmartPointer<vtkSchlierenFilter>::New();
  filter->SetInputDataObject(reader->GetOutput());
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "rho");
  filter->SetImageSize(360, 194);
  traceEveryVoxel(filter, 4);
  filter->SetDevice(vtkSchlierenFilter::CPU);
  return filter;
}

} // namespace

TEST(Images, JetKnifeEdgeAcrossTheAxis)
{
  auto filter = jet();
  filter->Update();
  expectBaseline(filter, 1, "JetKnifeEdge0");
}

TEST(Images, JetKnifeEdgeAlongTheAxis)
{
  auto filter = jet();
  filter->SetKnifeEdgeAngle(90);
  filter->Update();
  expectBaseline(filter, 1, "JetKnifeEdge90");
}

TEST(Images, JetShadowgraph)
{
  auto filter = jet();
  filter->SetCutoff(vtkSchlierenFilter::SHADOWGRAPH);
  filter->SetScreenDistance(0.02);
  filter->Update();
  expectBaseline(filter, 2, "JetShadowgraph");
}

namespace
{

vtkSmartPointer<vtkDataObject> bluntFin()
{
  vtkNew<vtkMultiBlockPLOT3DReader> reader;
  reader->SetXYZFileName((data + "/bluntfin_plot3d/bluntfinxyz.bin").c_str());
  reader->SetQFileName((data + "/bluntfin_plot3d/bluntfinq.bin").c_str());
  reader->SetScalarFunctionNumber(100); // density
  reader->AutoDetectFormatOn();
  reader->Update();
  return reader->GetOutput();
}

/// Length and density are chosen: a fin 10 mm thick, 0.1 kg/m^3 in the free stream.
vtkSmartPointer<vtkSchlierenFilter> finBench(vtkDataObject* input)
{
  auto filter = vtkSmartPointer<vtkSchlierenFilter>::New();
  filter->SetInputDataObject(input);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  filter->SetDensityScale(0.1);
  filter->SetLengthScale(0.01);
  traceEveryVoxel(filter, 4);
  filter->SetDevice(vtkSchlierenFilter::CPU);
  return filter;
}

/// Both halves of a half model with the symmetry plane y = 0.
vtkSmartPointer<vtkDataObject> bothHalves(vtkDataObject* half)
{
  vtkNew<vtkReflectionFilter> reflect;
  reflect->SetInputDataObject(half);
  reflect->SetPlane(vtkReflectionFilter::USE_Y);
  reflect->CopyInputOn();
  reflect->Update();
  return reflect->GetOutputDataObject(0);
}

} // namespace

// The bow shock in plan view: a curvilinear half model, whose fin blocks the light. The steps behind the
// shock are the cells of the computation, within which the density is linear.
TEST(Images, BluntFinFromAbove)
{
  auto filter = finBench(bluntFin());
  filter->SetFocalPoint(1, 2.5, 2);
  filter->SetParallelScale(3);
  filter->SetImageSize(256, 256);
  filter->Update();
  expectBaseline(filter, 1, "BluntFinFromAbove");
}

// The lambda shock that the fin drives up the plate's boundary layer (z = 0), seen from the side: through
// the corners of the box, which the mesh leaves out, as it does the fin; that is given as a surface.
TEST(Images, BluntFinFromTheSide)
{
  const auto half = bluntFin();
  auto filter = finBench(bothHalves(half));
  vtkNew<vtkExtractGrid> wall;
  wall->SetInputData(vtkMultiBlockDataSet::SafeDownCast(half)->GetBlock(0));
  wall->SetVOI(0, 39, 0, 0, 0, 31);
  wall->Update();
  vtkNew<vtkDataSetSurfaceFilter> fin;
  fin->SetInputDataObject(bothHalves(wall->GetOutput()));
  fin->Update();
  filter->SetInputDataObject(vtkRefractiveIndex::BODIES, fin->GetOutput());
  filter->SetOutside(vtkRefractiveIndex::OUTSIDE_PASSES);
  filter->SetViewDirection(0, 1, 0);
  filter->SetViewUp(0, 0, 1);
  filter->SetFocalPoint(-1.5, 0, 2);
  filter->SetParallelScale(2.2);
  filter->SetImageSize(128, 110);
  filter->Update();
  const std::vector<double> blocked = valuesOf(filter, "BlockedFraction");
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  for (std::size_t i = 0; i < blocked.size(); ++i)
  {
    const double* x = image->GetPoint(static_cast<vtkIdType>(i));
    if (x[1] > 0.21 && std::abs(x[0]) > 0.21) // 1.5 voxels
    {
      ASSERT_EQ(blocked[i], x[0] > 0 ? 1 : 0) << x[0] << " " << x[1];
    }
  }
  expectBaseline(filter, 1, "BluntFinFromTheSide");
}
