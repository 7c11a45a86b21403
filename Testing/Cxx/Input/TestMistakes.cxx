// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fixtures.h"

#include "vtkLineSource.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkUnstructuredGrid.h"

#include <limits>
#include <ostream>

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A wrong input or setting (what the tracer refuses is said alike), what the message must contain, and how to put it right.
struct Mistake
{
  const char* name;
  std::function<void(vtkSchlierenFilter*)> make;
  std::vector<std::string> words;
  std::function<void(vtkSchlierenFilter*)> correct;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

void chooseArray(vtkSchlierenFilter* filter, const char* name)
{
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
}

/// A mistake of the input: put right with another one.
Mistake input(const char* name, const std::function<vtkSmartPointer<vtkDataObject>()>& make,
  std::vector<std::string> words)
{
  return { name, [make](vtkSchlierenFilter* filter) { filter->SetInputDataObject(make()); },
    std::move(words),
    [](vtkSchlierenFilter* filter) { filter->SetInputDataObject(columnImage(16)); } };
}

vtkSmartPointer<vtkDataObject> line()
{
  auto image = columnImage(16);
  image->SetDimensions(16, 1, 1);
  image->GetPointData()->Initialize();
  addPointArray(image, "N", GaussianColumn());
  return image;
}

vtkSmartPointer<vtkDataObject> lineOfMesh()
{
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  vtkPolyData* square = plane->GetOutput();
  for (vtkIdType i = 0; i < square->GetNumberOfPoints(); ++i)
  {
    square->GetPoints()->SetPoint(i, square->GetPoint(i)[0], 0, 0);
  }
  addPointArray(square, "N", GaussianColumn());
  return square;
}

vtkSmartPointer<vtkDataObject> tiltedPlane()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetNormal(1, 1, 1);
  plane->Update();
  addPointArray(plane->GetOutput(), "N", GaussianColumn());
  return plane->GetOutput();
}

vtkSmartPointer<vtkDataObject> polyLine()
{
  vtkNew<vtkLineSource> source;
  source->Update();
  addPointArray(source->GetOutput(), "N", GaussianColumn());
  return source->GetOutput();
}

vtkSmartPointer<vtkDataObject> surface()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  addPointArray(sphere->GetOutput(), "N", GaussianColumn());
  return sphere->GetOutput();
}

vtkSmartPointer<vtkDataObject> vectors()
{
  auto image = cube(16);
  vtkNew<vtkDoubleArray> array;
  array->SetName("N");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  array->Fill(0);
  image->GetPointData()->AddArray(array);
  addPointArray(image, "p", GaussianColumn());
  return image;
}

using Filter = vtkSchlierenFilter;

std::vector<Mistake> mistakes()
{
  return {
    { "NoSuchArray", [](Filter* f) { chooseArray(f, "rho_total"); },
      { "rho_total", "IndexArray", "N" }, [](Filter* f) { chooseArray(f, "N"); } },
    { "NoArrayChosen", [](Filter* f) { chooseArray(f, ""); }, { "IndexArray", "point arrays N" },
      [](Filter* f) { chooseArray(f, "N"); } },
    input("NoArrays", [] { return cube(16); }, { "no arrays", "IndexArray" }),
    input("Vectors", vectors, { "'N' has 3 components", "point arrays p" }),
    input("OnlyVectors",
      []
      {
        const auto image = vectors();
        vtkDataSet::SafeDownCast(image)->GetPointData()->RemoveArray("p");
        return image;
      },
      { "'N' has 3 components", "Calculator" }),
    input("EmptyGrid", [] { return vtkSmartPointer<vtkUnstructuredGrid>::New(); }, { "empty" }),
    input("EmptyImage", [] { return vtkSmartPointer<vtkImageData>::New(); }, { "empty" }),
    input(
      "EmptyComposite", [] { return vtkSmartPointer<vtkMultiBlockDataSet>::New(); }, { "empty" }),
    input("NanEverywhere",
      []
      {
        auto image = columnImage(16);
        image->GetPointData()->GetArray("N")->Fill(nan);
        return image;
      },
      { "'N'", "no valid value" }),
    input("Line", line, { "a line or a point", "2-D" }),
    input("LineOfMesh", lineOfMesh, { "a line or a point" }),
    input("Surface", surface, { "no 3-D cells", "'N'", "one plane" }),
    input("TiltedPlane", tiltedPlane, { "no 3-D cells", "one plane", "Transform" }),
    input("PolyLine", polyLine, { "no 3-D cells", "one plane" }),
    input("ZeroSpacing",
      []
      {
        auto image = columnImage(16);
        image->SetSpacing(0.1, 0, 0.1);
        return image;
      },
      { "spacing", "y axis", "positive" }),
    { "IndexTakenForRefractivity",
      [](Filter* f)
      {
        f->SetDensityScale(1);
        f->SetIndexModel(vtkRefractiveIndex::GLADSTONE_DALE);
        f->SetInputArrayToProcess(
          vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
        f->SetGladstoneDaleConstant(1e9);
      },
      { "n - 1", "index model" }, [](Filter* f) { f->SetGladstoneDaleConstant(1); } },
    { "NegativeHeight", [](Filter* f) { f->SetImageSize(64, -3); }, { "64 x -3", "ImageSize" },
      [](Filter* f) { f->SetImageSize(64, 64); } },
    { "NoSamples", [](Filter* f) { f->SetSamplesPerPixel(0); }, { "SamplesPerPixel", "0" },
      [](Filter* f) { f->SetSamplesPerPixel(1); } },
    { "NanScreen", [](Filter* f) { f->SetScreenDistance(nan); }, { "ScreenDistance" },
      [](Filter* f) { f->SetScreenDistance(-1); } },
    { "NanAmbient", [](Filter* f) { f->SetAmbientRefractivity(nan); }, { "ambient" },
      [](Filter* f) { f->SetAmbientRefractivity(0); } },
  };
}

class Mistakes : public testing::TestWithParam<Mistake>
{
};

} // namespace

TEST_P(Mistakes, OneMessageAnEmptyImageAndThenAllIsWell)
{
  const Mistake& mistake = GetParam();
  auto filter = bench(columnImage(16));
  expectOneMessage(filter.Get(), mistake.make, mistake.words, mistake.correct);
  EXPECT_GT(largest(valuesOf(filter, "Deflection")), 0);
}

INSTANTIATE_TEST_SUITE_P(Bench, Mistakes, testing::ValuesIn(mistakes()),
  [](const testing::TestParamInfo<Mistake>& mistake) { return mistake.param.name; });

// A machine with a device passes by tracing there, one without by saying so.
TEST(Devices, CudaIsUsedOrItsAbsenceIsSaid)
{
  auto filter = bench(columnImage(16));
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->SetDevice(vtkSchlierenFilter::CUDA);
  filter->Update();
  if (complaints->Errors.empty())
  {
    EXPECT_FALSE(isEmpty(filter));
    auto* device = filter->GetOutputDataObject(0)->GetFieldData()->GetAbstractArray("Device");
    EXPECT_EQ(device->GetVariantValue(0).ToString(), "CUDA");
  }
  else
  {
    ASSERT_EQ(complaints->Errors.size(), 1u);
    EXPECT_NE(complaints->Errors[0].find("CUDA"), std::string::npos);
    EXPECT_NE(complaints->Errors[0].find("CPU"), std::string::npos);
    EXPECT_TRUE(isEmpty(filter));
  }
  filter->SetDevice(vtkSchlierenFilter::AUTO);
  filter->Update();
  EXPECT_FALSE(isEmpty(filter));
}
