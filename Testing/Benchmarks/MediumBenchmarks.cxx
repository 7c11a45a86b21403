// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What the medium and its homogeneity map cost: points per second of a core's time, the best of all
// builds, so that what else runs on the machine matters little; and the peak of memory while both are
// built. Two threads on two free cores take half of the core's time.
#include "Medium/HomogeneityMap.h"
#include "PeakMemory.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

namespace
{

using namespace schlieren;

enum Body
{
  None,
  Ball,
  Foam ///< every other point is solid
};

/// A Gaussian ball of gas, and behind it what is solid.
struct Flow
{
  Flow(std::int64_t n, Body body)
  {
    field.grid.dimensions = { n, n, n };
    const double h = 2 / static_cast<double>(n - 1);
    for (std::int64_t k = 0; k < n; ++k)
    {
      for (std::int64_t j = 0; j < n; ++j)
      {
        for (std::int64_t i = 0; i < n; ++i)
        {
          const double x = h * static_cast<double>(i) - 1;
          const double y = h * static_cast<double>(j) - 1;
          const double z = h * static_cast<double>(k) - 1;
          const double square = x * x + y * y + z * z;
          samples.push_back(static_cast<float>(3e-4 * std::exp(-10 * square)));
          valid.push_back(
            (body == Ball && square < z) || (body == Foam && (i + j + k) % 2 == 0) ? 0 : 1);
        }
      }
    }
    field.singles = samples.data();
    field.valid = body == None ? nullptr : valid.data();
  }

  Field field;
  std::vector<float> samples;
  std::vector<unsigned char> valid;
};

/// That all threads have spent so far.
double coreSeconds()
{
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Arguments: grid points per axis, interpolation, body, threads.
void mediumAndMap(benchmark::State& state)
{
  const Flow flow(state.range(0), static_cast<Body>(state.range(2)));
  const auto interpolation = static_cast<Interpolation>(state.range(1));
  const int threads = static_cast<int>(state.range(3));
  double mediumSeconds = 1e30, mapSeconds = 1e30, wallSeconds = 1e30;
  std::size_t peakBytes = 0;
  for (auto _ : state)
  {
    const PeakMemory peak;
    const double start = coreSeconds();
    const Medium<float> medium = buildMedium<float>(flow.field, interpolation, threads);
    const double middle = coreSeconds();
    const auto wall = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(buildHomogeneityMap(medium, interpolation, 1e-8f, threads));
    wallSeconds = std::min(
      wallSeconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count());
    mapSeconds = std::min(mapSeconds, coreSeconds() - middle);
    mediumSeconds = std::min(mediumSeconds, middle - start);
    peakBytes = peak.bytes();
  }
  const auto voxels = static_cast<double>(flow.samples.size());
  state.counters["medium/core-s"] = voxels / mediumSeconds;
  state.counters["map/core-s"] = voxels / mapSeconds;
  state.counters["map/s"] = voxels / wallSeconds;
  state.counters["peak/volume"] = static_cast<double>(peakBytes) / (4 * voxels);
}

void arguments(benchmark::internal::Benchmark* b)
{
  b->ArgNames({ "n", "interpolation", "body", "threads" });
  for (const int n : { 128, 256, 512 })
  {
    for (int interpolation = 0; interpolation < 4; ++interpolation)
    {
      for (const Body body : { None, Ball, Foam })
      {
        b->Args({ n, interpolation, body, 0 });
      }
    }
  }
  for (int interpolation = 0; interpolation < 4; ++interpolation)
  {
    b->Args({ 256, interpolation, None, 1 });
  }
}
BENCHMARK(mediumAndMap)->Apply(arguments)->UseRealTime()->MinTime(2)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
