// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// How many images of 512 x 512 pixels a second the filter makes: with another knife edge, and with
// another camera; the pipeline's and the output arrays' part included.
#include "TimedImages.h"

#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageDataToPointSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRefractiveIndex.h"
#include "vtkSchlierenFilter.h"
#include "vtkSmartPointer.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace
{

/// Refractivity "N" of a ball of warm gas.
vtkSmartPointer<vtkImageData> ball(int points)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(points, points, points);
  const double h = 2. / (points - 1);
  image->SetSpacing(h, h, h);
  image->SetOrigin(-1, -1, -1);
  vtkNew<vtkFloatArray> refractivity;
  refractivity->SetName("N");
  refractivity->SetNumberOfValues(image->GetNumberOfPoints());
  vtkIdType id = 0;
  for (int k = 0; k < points; ++k)
  {
    for (int j = 0; j < points; ++j)
    {
      for (int i = 0; i < points; ++i)
      {
        const double r = std::hypot(h * i - 1, h * j - 1, h * k - 1);
        refractivity->SetValue(
          id++, static_cast<float>(2.7e-4 - 1e-4 / (1 + std::exp(40 * (r - 0.6)))));
      }
    }
  }
  image->GetPointData()->AddArray(refractivity);
  return image;
}

vtkSmartPointer<vtkSchlierenFilter> filterOf(vtkDataObject* input, benchmark::State& state)
{
  auto filter = vtkSmartPointer<vtkSchlierenFilter>::New();
  filter->SetInputDataObject(input);
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
  filter->SetDevice(vtkSchlierenFilter::CPU);
  filter->SetSamplesPerPixel(static_cast<int>(state.range(0)));
  filter->SetNumberOfThreads(static_cast<int>(state.range(1)));
  filter->SetStepSize(2);
  filter->SetViewDirection(-0.3, 0.1, -1);
  filter->Update();
  return filter;
}

/// Updates after each change(filter).
template <class Change>
void updateAgain(benchmark::State& state, vtkSchlierenFilter* filter, const Change& change)
{
  timeImages(state,
    [&]
    {
      change(filter);
      filter->Update();
      return filter->GetOutput()->GetFieldData()->GetArray("TraceSeconds")->GetComponent(0, 0);
    });
}

void turnKnife(vtkSchlierenFilter* filter)
{
  filter->SetKnifeEdgeAngle(filter->GetKnifeEdgeAngle() + 1);
}

void filterShadesAgain(benchmark::State& state)
{
  updateAgain(state, filterOf(ball(64), state), turnKnife);
}
BENCHMARK(filterShadesAgain)
  ->ArgNames({ "samples", "threads" })
  ->ArgsProduct({ { 1, 4 }, { 1, 2 } })
  ->MeasureProcessCPUTime()
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

/// As many points, as a mesh that has been resampled.
void filterShadesMeshAgain(benchmark::State& state)
{
  vtkNew<vtkImageDataToPointSet> mesh;
  mesh->SetInputData(ball(64));
  mesh->Update();
  updateAgain(state, filterOf(mesh->GetOutput(), state), turnKnife);
}
BENCHMARK(filterShadesMeshAgain)
  ->ArgNames({ "samples", "threads" })
  ->Args({ 1, 2 })
  ->MeasureProcessCPUTime()
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

/// The camera goes round the medium of 256 points each way, three degrees an image.
void filterHasNewCamera(benchmark::State& state)
{
  double angle = 0;
  updateAgain(state, filterOf(ball(256), state),
    [&angle](vtkSchlierenFilter* filter)
    {
      angle += 3 * std::acos(-1.) / 180;
      filter->SetViewDirection(-std::sin(angle), -0.3, -std::cos(angle));
    });
}
BENCHMARK(filterHasNewCamera)
  ->ArgNames({ "samples", "threads" })
  ->Args({ 1, 2 })
  ->Iterations(5)
  ->MeasureProcessCPUTime()
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

/// The same in images of fewer pixels.
void filterPreviews(benchmark::State& state)
{
  double angle = 0;
  auto filter = filterOf(ball(256), state);
  filter->SetPreviewReduction(static_cast<int>(state.range(2)));
  updateAgain(state, filter,
    [&angle](vtkSchlierenFilter* turned)
    {
      angle += 3 * std::acos(-1.) / 180;
      turned->SetViewDirection(-std::sin(angle), -0.3, -std::cos(angle));
    });
}
BENCHMARK(filterPreviews)
  ->ArgNames({ "samples", "threads", "reduction" })
  ->ArgsProduct({ { 1 }, { 2 }, { 1, 2, 4, 8 } })
  ->MeasureProcessCPUTime()
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

/// An image of so many samples per pixel, in time slices of so many microseconds; 0: at once. Its rays are new.
void filterRefines(benchmark::State& state)
{
  auto filter = filterOf(ball(256), state);
  const int pixels = static_cast<int>(state.range(2));
  filter->SetImageSize(pixels, pixels);
  const double limit = 1e-6 * static_cast<double>(state.range(3));
  double longest = 0;
  double longestWait = 0; // for a new image
  double slices = 0;
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start)
  { return std::chrono::duration<double>(Clock::now() - start).count(); };
  for (auto _ : state)
  {
    filter->SetTimeLimit(limit);
    filter->SetStepSize(filter->GetStepSize() * (1 + 1e-6)); // traces all rays again
    Clock::time_point shown = Clock::now();
    do
    {
      filter->Refine();
      const vtkTypeInt64 images = filter->GetImageCount();
      const Clock::time_point start = Clock::now();
      filter->Update();
      longest = std::max(longest, since(start));
      ++slices;
      if (filter->GetImageCount() != images)
      {
        longestWait = std::max(longestWait, since(shown));
        shown = Clock::now();
      }
    } while (!filter->GetFinished());
  }
  state.counters["longest/ms"] = 1e3 * longest;
  state.counters["wait/ms"] = 1e3 * longestWait;
  state.counters["slices"] = slices / static_cast<double>(state.iterations());
}
BENCHMARK(filterRefines)
  ->ArgNames({ "samples", "threads", "pixels", "limit/us" })
  ->ArgsProduct({ { 16 }, { 2 }, { 512, 1024 }, { 0, 60000, 20000, 1 } })
  ->Iterations(2)
  ->MeasureProcessCPUTime()
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
