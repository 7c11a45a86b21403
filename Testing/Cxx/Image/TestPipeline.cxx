// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fixtures.h"
#include "WatchedProgress.h"

#include "vtkGasTable.h"
#include "vtkHyperTreeGrid.h"
#include "vtkImageFlip.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkPassThrough.h"
#include "vtkPoints.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkTrivialProducer.h"

namespace
{

struct WorkDone
{
  vtkTypeInt64 builds;
  vtkTypeInt64 rays;
};

bool operator==(const WorkDone& a, const WorkDone& b)
{
  return a.builds == b.builds && a.rays == b.rays;
}

/// What an update adds to the work done.
WorkDone workOfUpdate(vtkSchlierenFilter* filter)
{
  const WorkDone before{ filter->GetMediumBuilds(), filter->GetTotalRaysTraced() };
  filter->Update();
  return { filter->GetMediumBuilds() - before.builds, filter->GetTotalRaysTraced() - before.rays };
}

const WorkDone none{ 0, 0 };

} // namespace

TEST(Pipeline, OutputIsAsDocumented)
{
  auto filter = bench(columnImage(32), 20);
  filter->SetImageSize(20, 12);
  filter->Update();
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  const int expected[6] = { 0, 19, 0, 11, 0, 0 };
  EXPECT_TRUE(std::equal(expected, expected + 6, image->GetExtent()));
  EXPECT_EQ(image->GetOrigin()[2], 0);
  EXPECT_STREQ(image->GetPointData()->GetScalars()->GetName(), "Intensity");
  const std::tuple<const char*, int, int> arrays[] = { { "Intensity", VTK_FLOAT, 1 },
    { "Deflection", VTK_FLOAT, 3 }, { "OpticalPathDifference", VTK_DOUBLE, 1 },
    { "Displacement", VTK_FLOAT, 3 }, { "BlockedFraction", VTK_FLOAT, 1 } };
  for (const auto& [name, type, components] : arrays)
  {
    vtkDataArray* array = arrayOf(filter, name);
    ASSERT_NE(array, nullptr) << name;
    EXPECT_EQ(array->GetDataType(), type) << name;
    EXPECT_EQ(array->GetNumberOfComponents(), components) << name;
    EXPECT_EQ(array->GetNumberOfTuples(), 20 * 12) << name;
  }
  EXPECT_GT(fieldValue(filter, "KScale"), 0);
  EXPECT_GT(fieldValue(filter, "StepsTaken"), 0);
  EXPECT_GT(fieldValue(filter, "TraceSeconds"), 0);
  EXPECT_GE(fieldValue(filter, "MomentumDrift"), 0);
  EXPECT_LT(fieldValue(filter, "MomentumDrift"), 1e-5);
  EXPECT_EQ(fieldValue(filter, "RaysLost"), 0);
  EXPECT_EQ(fieldValue(filter, "AmbientRefractivity"), 0);
  EXPECT_GE(fieldValue(filter, "RaysTraced"), 12 * 12);
  vtkFieldData* field = image->GetFieldData();
  EXPECT_TRUE(vtkStringArray::SafeDownCast(field->GetAbstractArray("Device")));
  EXPECT_TRUE(vtkStringArray::SafeDownCast(field->GetAbstractArray("PathModel")));
}

// Of the data of the last image: what others are is known with them.
TEST(Pipeline, InformationHasTheGeometryBeforehand)
{
  auto filter = bench(columnImage(32), 20);
  filter->Update();
  filter->SetImageSize(30, 20);
  filter->SetParallelScale(0.7);
  filter->UpdateInformation();
  vtkInformation* info = filter->GetOutputInformation(0);
  double origin[3], spacing[3];
  info->Get(vtkDataObject::ORIGIN(), origin);
  info->Get(vtkDataObject::SPACING(), spacing);
  filter->Update();
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(image->GetOrigin()[axis], origin[axis]);
    EXPECT_EQ(image->GetSpacing()[axis], spacing[axis]);
  }
  EXPECT_TRUE(std::equal(image->GetExtent(), image->GetExtent() + 6,
    info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())));
  EXPECT_EQ(vtkImageData::GetScalarType(info), VTK_FLOAT);
}

TEST(Pipeline, DataWithoutAnImageDoNotSpoilThatOfTheNext)
{
  auto boundless = columnImage(32);
  boundless->SetSpacing(1e307, 1e307, 1e307);
  auto filter = bench(boundless, 20);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(isEmpty(filter));
  ASSERT_EQ(complaints->Errors.size(), 1u);
  EXPECT_NE(complaints->Errors[0].find("has no extent"), std::string::npos);
  filter->SetInputDataObject(columnImage(32));
  filter->Update();
  EXPECT_EQ(complaints->Errors.size(), 1u);
  auto other = bench(columnImage(32), 20);
  other->Update();
  EXPECT_EQ(valuesOf(filter, "Intensity"), valuesOf(other, "Intensity"));
}

TEST(Pipeline, RequestsFitHyperTrees)
{
  vtkNew<vtkHyperTreeGrid> trees;
  trees->SetDimensions(3, 3, 3);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(trees);
  auto filter = bench(columnImage(8), 20);
  filter->SetInputConnection(producer->GetOutputPort());
  auto ofFilter = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  auto ofVtk = vtkSmartPointer<Complaints>::Take(new Complaints(producer));
  filter->Update();
  EXPECT_EQ(ofFilter->Errors.size(), 1u); // which names the filter to use before
  EXPECT_TRUE(ofVtk->Errors.empty());
}

TEST(Pipeline, OutputsAreNotTurnedWithTheInput)
{
  const double turned[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  const double unturned[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  auto input = columnImage(32);
  input->SetDirectionMatrix(turned);
  auto filter = bench(input, 20);
  filter->Update();
  for (int port : { vtkSchlierenFilter::IMAGE_PORT, vtkSchlierenFilter::HISTOGRAM_PORT })
  {
    auto* output = vtkImageData::SafeDownCast(filter->GetOutputDataObject(port));
    vtkInformation* info = filter->GetOutputInformation(port);
    // As VTK does it since 9.3, before RequestInformation and before RequestData.
    info->Set(vtkDataObject::DIRECTION(), turned, 9);
    filter->Modified();
    filter->UpdateInformation();
    EXPECT_TRUE(std::equal(unturned, unturned + 9, info->Get(vtkDataObject::DIRECTION()))) << port;
    info->Set(vtkDataObject::DIRECTION(), turned, 9);
    output->SetDirectionMatrix(turned);
    filter->Update(port);
    EXPECT_TRUE(std::equal(unturned, unturned + 9, output->GetDirectionMatrix()->GetData()))
      << port;
  }
}

TEST(Pipeline, NothingIsDoneTwice)
{
  auto image = columnImage(32);
  auto filter = bench(image, 32);
  EXPECT_EQ(workOfUpdate(filter).builds, 1);
  EXPECT_TRUE(workOfUpdate(filter) == none);

  // What turns rays into light and dark needs no re-tracing.
  filter->SetKnifeEdgeAngle(90);
  EXPECT_TRUE(workOfUpdate(filter) == none);
  filter->SetCutoffOffset(0.1);
  EXPECT_TRUE(workOfUpdate(filter) == none);
  filter->SetKMode(vtkSchlierenFilter::K_VALUE);
  filter->SetKScale(123);
  EXPECT_TRUE(workOfUpdate(filter) == none);
  EXPECT_EQ(fieldValue(filter, "KScale"), 123);
  for (int cutoff = vtkSchlierenFilter::SHADOWGRAPH; cutoff <= vtkSchlierenFilter::INTERFEROGRAM;
       ++cutoff)
  {
    filter->SetCutoff(cutoff);
    EXPECT_TRUE(workOfUpdate(filter) == none) << cutoff;
  }
  filter->SetFringeSpacing(-10);
  EXPECT_TRUE(workOfUpdate(filter) == none);
  filter->SetSmoothingRadius(2);
  EXPECT_TRUE(workOfUpdate(filter) == none);
  EXPECT_EQ(fieldValue(filter, "TraceSeconds"), 0);

  // A view traces, and keeps the medium.
  filter->SetViewDirection(1, 0, 0);
  WorkDone done = workOfUpdate(filter);
  EXPECT_EQ(done.builds, 0);
  EXPECT_GT(done.rays, 0);

  // What the medium is made from builds it.
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVE_INDEX);
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  filter->SetAmbientRefractivity(1e-5);
  EXPECT_EQ(workOfUpdate(filter).builds, 1);
  image->GetPointData()->GetArray("N")->SetComponent(0, 0, 2e-5);
  image->GetPointData()->GetArray("N")->Modified();
  EXPECT_EQ(workOfUpdate(filter).builds, 1);

  // Values that were changed in place, announced by the dataset alone.
  image->GetPointData()->GetArray("N")->SetComponent(0, 0, 3e-5);
  image->Modified();
  EXPECT_EQ(workOfUpdate(filter).builds, 1);
  image->SetSpacing(0.1, 0.1, 0.1);
  EXPECT_EQ(workOfUpdate(filter).builds, 1);

  // The same data, handed on by a filter upstream that runs again for another part of them.
  vtkNew<vtkPassThrough> upstream;
  upstream->SetInputDataObject(image);
  filter->SetInputConnection(upstream->GetOutputPort());
  EXPECT_EQ(workOfUpdate(filter).builds, 1);
  EXPECT_TRUE(workOfUpdate(filter) == none);
  upstream->GetOutputInformation(0)->Remove(vtkDataObject::DATA_OBJECT());
  filter->SetKnifeEdgeAngle(10);
  EXPECT_TRUE(workOfUpdate(filter) == none);

  // Another number of threads makes nothing new.
  filter->SetNumberOfThreads(2);
  EXPECT_TRUE(workOfUpdate(filter) == none);
}

// The refractivity of a gas whose constant is given does not depend on it; that of helium does.
TEST(Pipeline, AnotherWavelengthConvertsOnlyWhatDependsOnIt)
{
  auto filter = bench(columnImage(24), 16);
  filter->Update();
  filter->SetWavelength(500);
  EXPECT_TRUE(workOfUpdate(filter) == none);
  filter->SetIndexModel(vtkRefractiveIndex::GLADSTONE_DALE);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
  filter->SetGladstoneDaleConstant(1);
  EXPECT_EQ(workOfUpdate(filter).builds, 1);
  filter->SetWavelength(600);
  EXPECT_TRUE(workOfUpdate(filter) == none);
  filter->SetGladstoneDaleConstant(0);
  filter->SetGas("helium");
  EXPECT_EQ(workOfUpdate(filter).builds, 1);
  const double red = largest(valuesOf(filter, "OpticalPathDifference"));
  filter->SetWavelength(400);
  EXPECT_EQ(workOfUpdate(filter).builds, 1);
  EXPECT_NEAR(largest(valuesOf(filter, "OpticalPathDifference")) / red,
    vtkGasTable::GetConstant("helium", 400) / vtkGasTable::GetConstant("helium", 600), 1e-5);
}

TEST(Pipeline, ChainWithRefractiveIndexIsTheSame)
{
  auto image = columnImage(40);
  const GaussianColumn column;
  addPointArray(image, "rho",
    [&](const Vec& x) { return x[1] > 0.7 ? std::nan("") : 1.2 + column(x) / 2.26e-4; });

  auto direct = vtkSmartPointer<vtkSchlierenFilter>::New();
  direct->SetInputDataObject(image);
  direct->SetInputArrayToProcess(
    vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "rho");
  direct->SetImageSize(40, 40);
  direct->Update();

  vtkNew<vtkRefractiveIndex> refractivity;
  refractivity->SetInputDataObject(image);
  refractivity->SetInputArrayToProcess(
    vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "rho");
  for (const char* density : { "", "Refractivity", "gone" })
  {
    vtkNew<vtkSchlierenFilter> chained;
    chained->SetInputConnection(refractivity->GetOutputPort());
    if (*density)
    {
      chained->SetInputArrayToProcess(
        vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, density);
    }
    chained->SetImageSize(40, 40);
    Complaints* complaints = new Complaints(chained);
    chained->Update();
    EXPECT_TRUE(complaints->Errors.empty());
    for (const char* name :
      { "Intensity", "Deflection", "OpticalPathDifference", "BlockedFraction" })
    {
      // Between them N is in single precision; in the filter alone what it differs by from its surroundings is.
      EXPECT_LT(relativeDifference(valuesOf(chained, name), valuesOf(direct, name)), 2e-5) << name;
    }
    complaints->Delete();
  }
  EXPECT_GT(largest(valuesOf(direct, "BlockedFraction")), 0);
}

TEST(Pipeline, FringesThatRoundingMovesAreSaid)
{
  auto filter = bench(columnImage(32), 20);
  filter->SetCutoff(vtkSchlierenFilter::INTERFEROGRAM);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Warnings.empty());
  // As many fringes as are rounded by 0.1 in single precision.
  double longest = 0;
  vtkDataArray* paths = arrayOf(filter, "OpticalPathDifference");
  for (vtkIdType i = 0; i < paths->GetNumberOfTuples(); ++i)
  {
    longest = std::max(longest, std::abs(paths->GetComponent(i, 0)));
  }
  filter->SetLengthScale(filter->GetLengthScale() * 5e5 * 632.8e-9 / longest);
  filter->Update();
  ASSERT_EQ(complaints->Warnings.size(), 1u);
  EXPECT_NE(complaints->Warnings[0].find("5e+05 wavelengths"), std::string::npos);
  EXPECT_NE(complaints->Warnings[0].find("Double"), std::string::npos);
  filter->SetPrecision(vtkSchlierenFilter::DOUBLE);
  filter->Update();
  EXPECT_EQ(complaints->Warnings.size(), 1u);
  filter->SetLengthScale(1e300);
  filter->Update();
  ASSERT_EQ(complaints->Warnings.size(), 2u);
  EXPECT_NE(complaints->Warnings[1].find("even double"), std::string::npos);
}

TEST(Pipeline, ACameraThatFocusesOnNothingIsSaid)
{
  auto filter = bench(columnImage(32), 20);
  filter->SetViewAngle(30);
  filter->SetFNumber(4);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->SetFocusDistance(20);
  filter->Update();
  EXPECT_TRUE(complaints->Warnings.empty());
  filter->SetFocusDistance(2000); // millimetres
  filter->Update();
  ASSERT_EQ(complaints->Warnings.size(), 1u);
  EXPECT_NE(complaints->Warnings[0].find("focuses 2000 data units away"), std::string::npos);
}

// As many pixels as 512 by 512 have.
TEST(Pipeline, ImagesHaveTheProportionsOfTheData)
{
  auto image = columnImage(24);
  const double* spacing = image->GetSpacing();
  image->SetSpacing(2 * spacing[0], spacing[1], spacing[2]);
  auto filter = bench(image, 32);
  filter->SetImageSize(0, 0);
  vtkNew<vtkImageFlip> flip; // requests what was promised
  flip->SetInputConnection(filter->GetOutputPort());
  const auto expectSize = [&filter](int width, int height)
  {
    const int* size = filter->GetOutput()->GetDimensions();
    EXPECT_EQ(size[0], width);
    EXPECT_EQ(size[1], height);
    const double* pixel = filter->GetOutput()->GetSpacing();
    EXPECT_DOUBLE_EQ(pixel[0], pixel[1]);
    filter->UpdateInformation();
    const int* promised =
      filter->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
    EXPECT_EQ(promised[1], width - 1);
    EXPECT_EQ(promised[3], height - 1);
    EXPECT_TRUE(workOfUpdate(filter) == none);
  };
  flip->Update();
  expectSize(724, 362);
  flip->Update();
  EXPECT_EQ(flip->GetOutput()->GetDimensions()[0], 724);
  filter->SetImageSize(0, 100);
  filter->Update();
  expectSize(200, 100);
  filter->SetImageSize(100, 0);
  filter->Update();
  expectSize(100, 50);
  filter->SetViewDirection(1, 0, 0);
  filter->Update();
  expectSize(100, 100);
  filter->SetImageSize(64, 48);
  filter->Update();
  expectSize(64, 48);
}

TEST(Pipeline, ScreenWithoutLightIsSaid)
{
  auto filter = bench(columnImage(32), 20);
  filter->SetCutoff(vtkSchlierenFilter::SHADOWGRAPH);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->Update();
  EXPECT_TRUE(complaints->Warnings.empty());
  filter->SetScreenDistance(1e29);
  filter->Update();
  ASSERT_EQ(complaints->Warnings.size(), 1u);
  EXPECT_NE(complaints->Warnings[0].find("Decrease ScreenDistance"), std::string::npos);
}
