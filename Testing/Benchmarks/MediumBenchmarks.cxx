// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What the medium and its homogeneity map cost: time, and the peak of memory while both are built, with
// and without a body in the flow.
#include "Medium/HomogeneityMap.h"
#include "PeakMemory.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>

namespace
{

using namespace schlieren;

/// A Gaussian ball of gas, and behind it a solid ball.
struct Flow
{
  explicit Flow(std::int64_t n)
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
          valid.push_back(square - z < 0 ? 0 : 1);
        }
      }
    }
    field.singles = samples.data();
  }

  Field field;
  std::vector<float> samples;
  std::vector<unsigned char> valid;
};

double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Arguments: grid points per axis, interpolation, whether there is a body, threads.
void mediumAndMap(benchmark::State& state)
{
  Flow flow(state.range(0));
  const auto interpolation = static_cast<Interpolation>(state.range(1));
  flow.field.valid = state.range(2) != 0 ? flow.valid.data() : nullptr;
  const int threads = static_cast<int>(state.range(3));
  double mediumSeconds = 0, mapSeconds = 0;
  std::size_t peakBytes = 0;
  for (auto _ : state)
  {
    const PeakMemory peak;
    auto start = std::chrono::steady_clock::now();
    const Medium<float> medium = buildMedium<float>(flow.field, interpolation, threads);
    mediumSeconds += secondsSince(start);
    start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(buildHomogeneityMap(medium, interpolation, 1e-8f, threads));
    mapSeconds += secondsSince(start);
    peakBytes = peak.bytes();
  }
  const auto voxels = static_cast<double>(flow.samples.size());
  const double all = voxels * static_cast<double>(state.iterations());
  state.counters["medium voxels/s"] = all / mediumSeconds;
  state.counters["map voxels/s"] = all / mapSeconds;
  state.counters["peak/volume"] = static_cast<double>(peakBytes) / (4 * voxels);
}

void arguments(benchmark::internal::Benchmark* b)
{
  b->ArgNames({ "n", "linear", "body", "threads" });
  for (const int n : { 128, 256, 512 })
  {
    for (const int linear : { 0, 1 })
    {
      for (const int body : { 0, 1 })
      {
        b->Args({ n, linear, body, 0 });
      }
    }
  }
  b->Args({ 256, 0, 0, 1 });
  b->Args({ 256, 1, 0, 1 });
}
BENCHMARK(mediumAndMap)->Apply(arguments)->UseRealTime()->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
