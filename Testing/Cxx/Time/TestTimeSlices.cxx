// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Time-sliced images, and what is shown in between.
#include "Fixtures.h"
#include "Series.h"
#include "WatchedProgress.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace
{

/// So short that each update does as little as it can.
constexpr double shortest = 1e-9;

vtkSmartPointer<vtkSchlierenFilter> smallBench(vtkDataObject* input)
{
  auto filter = bench(input, 40);
  filter->SetSamplesPerPixel(3);
  filter->SetNumberOfThreads(1); // so that slices are alike, however busy the machine is
  return filter;
}

/// Updates in time slices to the end, and counts them.
int updateInSlices(vtkSchlierenFilter* filter, double seconds = shortest)
{
  filter->SetTimeLimit(seconds);
  filter->Update();
  int slices = 1;
  for (constexpr int tooMany = 10000; !filter->GetFinished() && slices < tooMany; ++slices)
  {
    const vtkTypeInt64 images = filter->GetImageCount();
    const std::vector<double> before = valuesOf(filter, "Intensity");
    filter->Refine();
    filter->Update();
    EXPECT_TRUE(filter->GetImageCount() > images || valuesOf(filter, "Intensity") == before);
  }
  EXPECT_TRUE(filter->GetFinished());
  filter->SetTimeLimit(0);
  return slices;
}

void expectSameImage(vtkSchlierenFilter* a, vtkSchlierenFilter* b)
{
  for (int port = 0; port < 2; ++port)
  {
    auto* one = vtkImageData::SafeDownCast(a->GetOutputDataObject(port));
    auto* other = vtkImageData::SafeDownCast(b->GetOutputDataObject(port));
    ASSERT_GT(one->GetNumberOfPoints(), 0);
    EXPECT_TRUE(std::equal(one->GetExtent(), one->GetExtent() + 6, other->GetExtent()));
    EXPECT_TRUE(std::equal(one->GetOrigin(), one->GetOrigin() + 3, other->GetOrigin()));
    EXPECT_TRUE(std::equal(one->GetSpacing(), one->GetSpacing() + 3, other->GetSpacing()));
    vtkPointData* arrays = other->GetPointData();
    ASSERT_EQ(one->GetPointData()->GetNumberOfArrays(), arrays->GetNumberOfArrays());
    for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = arrays->GetArray(i);
      vtkDataArray* same = one->GetPointData()->GetArray(array->GetName());
      ASSERT_NE(same, nullptr) << array->GetName();
      ASSERT_EQ(same->GetNumberOfValues(), array->GetNumberOfValues()) << array->GetName();
      vtkIdType different = 0;
      for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
      {
        different += array->GetVariantValue(value) == same->GetVariantValue(value) ? 0 : 1;
      }
      EXPECT_EQ(different, 0) << array->GetName();
    }
  }
  for (const char* name : { "KScale", "RaysTraced", "StepsTaken", "LightOnFilm", "SaturatedShare" })
  {
    EXPECT_EQ(fieldValue(a, name), fieldValue(b, name)) << name;
  }
}

/// Progress of an update.
std::vector<double> progressOf(vtkSchlierenFilter* filter)
{
  const WatchedProgress watch(filter);
  filter->Update();
  return watch.seen;
}

} // namespace

TEST(TimeSlices, TheLimitIsNoModification)
{
  auto filter = smallBench(columnImage());
  filter->Update();
  const vtkMTimeType time = filter->GetMTime();
  filter->SetTimeLimit(1);
  EXPECT_EQ(filter->GetMTime(), time);
  EXPECT_TRUE(progressOf(filter).empty()); // nothing is run
  filter->Refine();                        // of a finished image
  EXPECT_EQ(filter->GetMTime(), time);
  EXPECT_TRUE(progressOf(filter).empty());

  filter->SetStepSize(1.5);
  filter->SetTimeLimit(shortest);
  filter->Update();
  EXPECT_FALSE(filter->GetFinished());
  EXPECT_TRUE(progressOf(filter).empty()); // it waits for Refine()
  EXPECT_FALSE(filter->GetFinished());
  filter->SetTimeLimit(0);
  EXPECT_TRUE(progressOf(filter).empty());
  filter->Refine();
  EXPECT_FALSE(progressOf(filter).empty());
  EXPECT_TRUE(filter->GetFinished()); // without a limit all is done
}

TEST(TimeSlices, ANewFilterBeginsWithAPreview)
{
  auto filter = smallBench(columnImage());
  filter->SetImageSize(200, 160);
  filter->SetTimeLimit(shortest);
  filter->Update();
  EXPECT_FALSE(filter->GetFinished());
  EXPECT_EQ(filter->GetImageCount(), 1);
  vtkImageData* image = filter->GetOutput();
  EXPECT_TRUE(std::equal(image->GetExtent(), image->GetExtent() + 6,
    filter->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())));
  EXPECT_EQ(image->GetPointData()->GetScalars()->GetNumberOfTuples(), 200 * 160);
  const std::vector<double> rough = valuesOf(filter, "Deflection");
  const Vec origin{ image->GetOrigin()[0], image->GetOrigin()[1], 0 };

  EXPECT_GT(updateInSlices(filter), 3);
  EXPECT_EQ(filter->GetImageCount(), 4); // one for each sample, too
  EXPECT_LT(relativeDifference(rough, valuesOf(filter, "Deflection")), 0.3);
  EXPECT_NEAR(image->GetOrigin()[0], origin[0], 1e-12);
  EXPECT_NEAR(image->GetOrigin()[1], origin[1], 1e-12);
}

TEST(TimeSlices, TheLastImageStaysUntilThereIsABetterOne)
{
  auto filter = smallBench(columnImage());
  filter->Update();
  const std::vector<double> last = valuesOf(filter, "Intensity");
  const vtkTypeInt64 images = filter->GetImageCount();
  const std::string status = filter->GetStatus();
  filter->SetViewDirection(0.5, 0.2, -1);
  filter->SetTimeLimit(shortest);
  filter->Update();
  EXPECT_FALSE(filter->GetFinished());
  EXPECT_EQ(valuesOf(filter, "Intensity"), last);
  EXPECT_EQ(filter->GetImageCount(), images);
  EXPECT_EQ(filter->GetStatus(), status);
  EXPECT_GT(filter->GetOutput(vtkSchlierenFilter::HISTOGRAM_PORT)->GetNumberOfPoints(), 0);

  while (filter->GetImageCount() == images)
  {
    filter->Refine();
    filter->Update();
  }
  EXPECT_NE(valuesOf(filter, "Intensity"), last);
  EXPECT_EQ(std::string(filter->GetStatus()).find("1 of 3 samples per pixel"), 0u)
    << filter->GetStatus();
  updateInSlices(filter);
  EXPECT_EQ(std::string(filter->GetStatus()).find("3 samples per pixel"), 0u)
    << filter->GetStatus();
}

// Slices of an animation may be too short for a ray for each pixel.
TEST(TimeSlices, ATimeStepIsNeverShownWithTheImageOfAnother)
{
  const vtkSmartPointer<Changing> data = series();
  auto filter = smallBench(columnImage());
  filter->SetInputConnection(data->GetOutputPort());
  filter->UpdateTimeStep(0);
  const std::vector<double> first = valuesOf(filter, "Deflection");
  filter->SetTimeLimit(shortest);
  filter->UpdateTimeStep(1);
  EXPECT_FALSE(filter->GetFinished());
  EXPECT_EQ(std::string(filter->GetStatus()).find("1 of 3 samples per pixel"), 0u)
    << filter->GetStatus();
  EXPECT_NEAR(
    relativeDifference(first, valuesOf(filter, "Deflection")), 0.5, 0.01); // twice as strong
}

// Of another size than the last one: filters after this one rely on the extent that was announced.
TEST(TimeSlices, TheLastImageFillsThePromisedExtent)
{
  auto filter = smallBench(columnImage());
  filter->SetCutoff(vtkSchlierenFilter::COLOR_FILTER);
  filter->Update();
  vtkImageData* image = filter->GetOutput();
  const double left = image->GetOrigin()[0] - 0.5 * image->GetSpacing()[0];
  const double width = 40 * image->GetSpacing()[0];
  const std::vector<double> last = valuesOf(filter, "Color");
  filter->SetImageSize(120, 20);
  filter->SetTimeLimit(shortest);
  filter->Update();
  for (int port = 0; port < 2; ++port)
  {
    image = filter->GetOutput(port);
    EXPECT_TRUE(std::equal(image->GetExtent(), image->GetExtent() + 6,
      filter->GetOutputInformation(port)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())));
    ASSERT_NE(image->GetPointData()->GetScalars(), nullptr);
    EXPECT_EQ(image->GetPointData()->GetScalars()->GetNumberOfTuples(), image->GetNumberOfPoints());
  }
  image = filter->GetOutput();
  EXPECT_STREQ(image->GetPointData()->GetScalars()->GetName(), "Color");
  EXPECT_NEAR(image->GetOrigin()[0] - 0.5 * image->GetSpacing()[0], left, 1e-12);
  EXPECT_NEAR(120 * image->GetSpacing()[0], width, 1e-12);
  const std::vector<double> stretched = valuesOf(filter, "Color");
  for (int row = 0; row < 20; ++row)
  {
    for (int column = 0; column < 120; ++column)
    {
      const auto to = static_cast<std::size_t>(3 * (row * 120 + column));
      const auto from = static_cast<std::size_t>(3 * ((2 * row + 1) * 40 + column / 3));
      EXPECT_EQ(stretched[to], last[from]);
    }
  }
  updateInSlices(filter);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 120 * 20);
}

TEST(TimeSlices, RefineBeginsAfterAnotherProperty)
{
  const auto image = columnImage();
  const std::pair<const char*, void (*)(vtkSchlierenFilter*)> changes[] = {
    { "cutoff", [](vtkSchlierenFilter* filter) { filter->SetKnifeEdgeAngle(60); } },
    { "view", [](vtkSchlierenFilter* filter) { filter->SetViewDirection(1, 0.2, 0); } },
    { "size", [](vtkSchlierenFilter* filter) { filter->SetImageSize(31, 20); } },
    { "ambient", [](vtkSchlierenFilter* filter) { filter->SetAmbientRefractivity(1e-5); } }
  };
  for (const auto& [what, change] : changes)
  {
    SCOPED_TRACE(what);
    auto fresh = smallBench(image);
    change(fresh);
    fresh->Update();

    auto filter = smallBench(image);
    filter->Update();
    const vtkMTimeType shown = filter->GetOutput()->GetMTime();
    const vtkTypeInt64 images = filter->GetImageCount();
    change(filter);
    EXPECT_TRUE(filter->GetFinished()); // nothing has been begun
    filter->SetTimeLimit(shortest);
    int slices = 0;
    for (; filter->GetImageCount() == images && slices < 10000; ++slices)
    {
      filter->Refine();
      EXPECT_FALSE(filter->GetFinished());
      EXPECT_EQ(filter->GetOutput()->GetMTime(), shown);
    }
    EXPECT_GT(slices, what == std::string("cutoff") ? 0 : 1);
    EXPECT_EQ(filter->GetImageCount(), images + 1);
    updateInSlices(filter);
    expectSameImage(filter, fresh);
    EXPECT_EQ(
      filter->GetMediumBuilds(), fresh->GetMediumBuilds() + (what == std::string("ambient")));

    // Whoever updates without a limit gets all of it.
    filter->SetStepSize(1.5);
    filter->SetTimeLimit(shortest);
    filter->Refine();
    EXPECT_FALSE(filter->GetFinished());
    filter->SetTimeLimit(0);
    filter->Update();
    fresh->SetStepSize(1.5);
    fresh->Update();
    expectSameImage(filter, fresh);
  }
}

TEST(TimeSlices, RefineLeavesTheMediumToUpdates)
{
  const auto image = columnImage();
  const std::pair<const char*, void (*)(vtkSchlierenFilter*)> changes[] = {
    { "nothing", [](vtkSchlierenFilter*) {} },
    { "input",
      [](vtkSchlierenFilter* filter)
      {
        auto* data = vtkImageData::SafeDownCast(filter->GetInputDataObject(0, 0));
        data->GetPointData()->GetArray("N")->SetComponent(2345, 0, 3e-4);
        data->GetPointData()->GetArray("N")->Modified();
      } },
    { "model", [](vtkSchlierenFilter* filter) { filter->SetGladstoneDaleConstant(1); } }
  };
  for (const auto& [what, change] : changes)
  {
    SCOPED_TRACE(what);
    auto filter = smallBench(image);
    filter->Update();
    const vtkTypeInt64 rays = filter->GetTotalRaysTraced();
    change(filter);
    filter->SetTimeLimit(shortest);
    filter->Refine();
    EXPECT_TRUE(filter->GetFinished());
    EXPECT_EQ(filter->GetTotalRaysTraced(), rays);
    updateInSlices(filter);
    auto fresh = smallBench(image);
    change(fresh);
    fresh->Update();
    expectSameImage(filter, fresh);
  }
  auto fresh = smallBench(image);
  fresh->SetTimeLimit(shortest);
  fresh->Refine(); // nothing has been shown yet
  EXPECT_TRUE(fresh->GetFinished());
  EXPECT_EQ(fresh->GetImageCount(), 0);
}

TEST(TimeSlices, AMistakeInTheMidstLeavesNothing)
{
  auto filter = smallBench(columnImage());
  filter->SetTimeLimit(shortest);
  filter->Update();
  EXPECT_FALSE(filter->GetFinished());
  expectOneMessage(
    filter.Get(),
    [](vtkSchlierenFilter* wrong)
    {
      wrong->SetStepSize(-1);
      wrong->Refine();
    },
    { "StepSize" },
    [](vtkSchlierenFilter* right)
    {
      EXPECT_TRUE(right->GetFinished());
      EXPECT_EQ(std::string(right->GetStatus()).rfind("No image: ", 0), 0u) << right->GetStatus();
      right->SetStepSize(1);
    });
  EXPECT_FALSE(filter->GetFinished());
  updateInSlices(filter);

  filter->SetStepSize(1.5);
  filter->SetTimeLimit(shortest);
  filter->Update();
  expectOneMessage(
    filter.Get(), // found before rays are thought of
    [](vtkSchlierenFilter* wrong)
    {
      wrong->SetInputArrayToProcess(
        vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "gone");
    },
    { "gone" },
    [](vtkSchlierenFilter* right)
    {
      EXPECT_TRUE(right->GetFinished());
      right->SetInputArrayToProcess(
        vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
    });
}

TEST(TimeSlices, AbortLeavesNothing)
{
  auto image = columnImage();
  for (const double limit : { 0., shortest })
  {
    auto filter = smallBench(image);
    filter->SetTimeLimit(shortest);
    filter->Update();
    EXPECT_FALSE(filter->GetFinished());
    filter->SetTimeLimit(limit);
    double fraction = 0.3; // while rays are traced
    if (limit > 0)
    {
      fraction = 0.01; // while the refractivity is found
      image->GetPointData()->GetArray("N")->Modified();
    }
    {
      const WatchedProgress watch(filter, fraction);
      filter->Refine();
      filter->Update();
    }
    EXPECT_TRUE(isEmpty(filter)) << limit;
    EXPECT_TRUE(filter->GetFinished()) << limit;
    EXPECT_EQ(filter->GetStopped(), limit > 0) << limit;
    EXPECT_EQ(*filter->GetStatus() != 0, limit > 0) << limit; // what there is not, and why
    if (limit > 0)
    {
      filter->Update(); // further requests need not wait again
      EXPECT_TRUE(isEmpty(filter));
      filter->Refine();
      EXPECT_FALSE(filter->GetStopped());
    }
    updateInSlices(filter);
    auto fresh = smallBench(image);
    fresh->Update();
    expectSameImage(filter, fresh);
  }
}

TEST(TimeSlices, StopLeavesWhatIsThere)
{
  auto image = columnImage();
  auto fresh = smallBench(image);
  fresh->Update();
  auto filter = smallBench(image);
  filter->Stop(); // nothing has been begun
  EXPECT_FALSE(filter->GetStopped());
  filter->SetTimeLimit(shortest);
  filter->Update();
  while (std::string(filter->GetStatus()).find("2 of 3 samples") != 0)
  {
    EXPECT_LT(filter->GetPercentDone(), 100);
    filter->Refine();
    filter->Update();
    ASSERT_FALSE(filter->GetFinished());
  }
  EXPECT_GE(filter->GetPercentDone(), 33);
  const std::vector<double> left = valuesOf(filter, "Intensity");
  filter->Stop();
  EXPECT_TRUE(filter->GetStopped());
  EXPECT_TRUE(filter->GetFinished());
  EXPECT_LT(filter->GetPercentDone(), 100);
  filter->SetTimeLimit(0);
  filter->Update();
  EXPECT_EQ(valuesOf(filter, "Intensity"), left);

  // It continues where it was, with a limit or without, and something else begins anew.
  const vtkTypeInt64 rays = filter->GetTotalRaysTraced();
  filter->Refine();
  EXPECT_FALSE(filter->GetStopped());
  EXPECT_FALSE(filter->GetFinished());
  updateInSlices(filter);
  expectSameImage(filter, fresh);
  EXPECT_EQ(filter->GetPercentDone(), 100);
  EXPECT_LT(filter->GetTotalRaysTraced() - rays, fresh->GetTotalRaysTraced());

  const double step = filter->GetStepSize();
  filter->SetStepSize(1.5);
  filter->SetTimeLimit(shortest);
  filter->Update();
  filter->Stop();
  EXPECT_TRUE(filter->GetStopped());
  filter->SetTimeLimit(0);
  filter->SetStepSize(step);
  EXPECT_FALSE(filter->GetStopped());
  filter->Update();
  expectSameImage(filter, fresh);
}

// Another time of the same source changes none of the filter's or the source's own times.
TEST(TimeSlices, WhatIsStoppedIsOneTimeStep)
{
  const auto steps = series();
  const auto atTime = [&steps](vtkSchlierenFilter* filter, double time)
  {
    filter->SetInputConnection(steps->GetOutputPort());
    filter->UpdateTimeStep(time);
  };
  auto filter = smallBench(nullptr);
  filter->SetKMode(vtkSchlierenFilter::K_VALUE);
  filter->SetTimeLimit(shortest);
  atTime(filter, 0);
  filter->Stop();
  ASSERT_TRUE(filter->GetStopped());
  filter->SetTimeLimit(0);
  atTime(filter, 2);
  EXPECT_FALSE(filter->GetStopped());
  auto fresh = smallBench(nullptr);
  fresh->SetKMode(vtkSchlierenFilter::K_VALUE);
  atTime(fresh, 2);
  expectSameImage(filter, fresh);
}

TEST(TimeSlices, ShowNoProgressButThatOfTheMedium)
{
  auto filter = smallBench(columnImage());
  filter->SetTimeLimit(shortest);
  const std::vector<double> first = progressOf(filter);
  EXPECT_GT(std::count_if(first.begin(), first.end(),
              [](double fraction) { return fraction > 0 && fraction < 0.2; }),
    0);
  filter->Refine();
  for (const double fraction : progressOf(filter))
  {
    EXPECT_TRUE(fraction == 0 || fraction == 1) << fraction;
  }
}
