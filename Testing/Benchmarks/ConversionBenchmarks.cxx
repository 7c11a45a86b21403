// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// A density to refractivity, against the least that could be done: reading it, writing as many numbers
// and a byte each for the mask. Both into new memory, which the system hands out page by page on the
// first write and which is most of the cost, if the volume is large; the two take turns, so that both
// meet the same machine. Points per second of a core's time, the median of all.
#include "Sources/MediumMaker.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRefractiveIndex.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace
{

/// That all threads have spent so far.
double coreSeconds()
{
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Work>
double secondsOf(const Work& work)
{
  const double start = coreSeconds();
  work();
  return coreSeconds() - start;
}

double median(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void stream(vtkFloatArray* density, vtkFloatArray* copy, vtkUnsignedCharArray* mask)
{
  const vtkIdType count = density->GetNumberOfValues();
  copy->SetNumberOfValues(count);
  mask->SetNumberOfValues(count);
  vtkSMPTools::For(0, count,
    [from = density->GetPointer(0), to = copy->GetPointer(0), ones = mask->GetPointer(0)](
      vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        to[i] = 2.26e-4f * from[i];
      }
      std::fill(ones + begin, ones + end, static_cast<unsigned char>(1));
    });
  benchmark::DoNotOptimize(copy->GetPointer(0));
  benchmark::DoNotOptimize(mask->GetPointer(0));
}

/// Arguments: grid points per axis, threads.
void convertDensity(benchmark::State& state)
{
  const int n = static_cast<int>(state.range(0));
  const int threads = static_cast<int>(state.range(1));
  vtkNew<vtkImageData> image;
  image->SetDimensions(n, n, n);
  vtkNew<vtkFloatArray> density;
  density->SetName("rho");
  density->SetNumberOfValues(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < density->GetNumberOfValues(); ++i)
  {
    density->SetValue(i, 1 + 1e-3f * static_cast<float>(i % 1000));
  }
  image->GetPointData()->AddArray(density);
  vtkNew<vtkRefractiveIndex> filter;
  filter->SetNumberOfThreads(threads);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "rho");

  std::vector<double> conversions, streamings;
  for (auto _ : state)
  {
    vtkNew<vtkImageData> output;
    conversions.push_back(secondsOf(
      [&] { filter->GetMaker().convert(image, output, nullptr, filters::Numbers::Singles); }));
    output->Initialize();
    vtkNew<vtkFloatArray> copy;
    vtkNew<vtkUnsignedCharArray> mask;
    const auto streamOnce = [&] { stream(density, copy, mask); };
    const vtkSMPTools::Config config(threads, "STDThread", false);
    vtkSMPTools::LocalScope(config, [&] { streamings.push_back(secondsOf(streamOnce)); });
  }
  const double conversion = median(conversions), streaming = median(streamings);
  const auto points = static_cast<double>(image->GetNumberOfPoints());
  state.counters["converted/core-s"] = points / conversion;
  state.counters["streamed/core-s"] = points / streaming;
  state.counters["ratio"] = conversion / streaming;
}
BENCHMARK(convertDensity)
  ->ArgNames({ "n", "threads" })
  ->ArgsProduct({ { 128, 256 }, { 1, 2 } })
  ->UseRealTime()
  ->MinTime(3)
  ->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
