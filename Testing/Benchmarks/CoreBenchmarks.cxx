// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// How fast each stage is, and how wrong: every image is compared with its closed form, so that speed
// and error stand in one table. Medium: a Gaussian column of radius 1 in a cube of half edge 4, seen
// across its axis in a direction that no grid axis shares.
#include "Schlieren.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace schlieren;

constexpr double peak = 1e-6; // weak enough that the closed form, a straight ray's, is exact
constexpr double half = 4;
constexpr Vector columnAxis = { 0.48, 0.6, 0.64 };

struct Column
{
  explicit Column(std::int64_t n)
  {
    field.grid.dimensions = { n, n, n };
    const double h = 2 * half / static_cast<double>(n - 1);
    field.grid.spacing = { h, h, h };
    field.grid.origin = { -half, -half, -half };
    field.ambient = 0;
    samples.reserve(static_cast<std::size_t>(n * n * n));
    for (std::int64_t k = 0; k < n; ++k)
    {
      for (std::int64_t j = 0; j < n; ++j)
      {
        for (std::int64_t i = 0; i < n; ++i)
        {
          const double x = h * static_cast<double>(i) - half;
          const double y = h * static_cast<double>(j) - half;
          const double z = h * static_cast<double>(k) - half;
          const double along = x * columnAxis[0] + y * columnAxis[1] + z * columnAxis[2];
          samples.push_back(
            static_cast<float>(peak * std::exp(along * along - x * x - y * y - z * z)));
        }
      }
    }
    field.singles = samples.data();
    field.version = static_cast<std::uint64_t>(n);
  }

  Field field;
  std::vector<float> samples;
};

const Column& column(std::int64_t n)
{
  static std::map<std::int64_t, std::unique_ptr<Column>> made;
  std::unique_ptr<Column>& one = made[n];
  if (!one)
  {
    one = std::make_unique<Column>(n);
  }
  return *one;
}

Scene sceneAcross(int pixels)
{
  Scene scene;
  scene.view.viewDirection = { -0.8, 0, 0.6 };
  scene.view.viewUp = columnAxis;
  scene.view.width = scene.view.height = pixels;
  scene.view.parallelScale = 0.9;
  scene.samplesPerPixel = 1;
  return scene;
}

/// Largest error of the deflection relative to the largest deflection.
double errorOf(const Image& image)
{
  double worst = 0;
  for (int row = 0; row < image.height; ++row)
  {
    for (int i = 0; i < image.width; ++i)
    {
      const double y = image.frame.origin[0] + i * image.frame.pixelSize;
      const double expected = -2 * std::sqrt(std::acos(-1.)) * peak * y * std::exp(-y * y);
      const auto pixel = static_cast<std::size_t>(row * image.width + i);
      worst = std::max(worst, std::abs(double{ image.deflection[2 * pixel] } - expected));
    }
  }
  return worst / (std::sqrt(2 * std::acos(-1.)) * peak * std::exp(-0.5));
}

void report(benchmark::State& state, const Image& image, double seconds)
{
  state.counters["rays/s"] =
    static_cast<double>(image.raysTraced) * static_cast<double>(state.iterations()) / seconds;
  state.counters["steps/s"] =
    static_cast<double>(image.stepsTaken) * static_cast<double>(state.iterations()) / seconds;
  state.counters["error"] = errorOf(image);
}

/// Arguments: grid points per axis, interpolation, precision, device, threads, step in 1/100 voxel.
void trace(benchmark::State& state)
{
  Scene scene = sceneAcross(256);
  scene.interpolation = static_cast<Interpolation>(state.range(1));
  scene.precision = static_cast<Precision>(state.range(2));
  scene.device = static_cast<Device>(state.range(3));
  scene.threads = static_cast<int>(state.range(4));
  scene.stepSize = static_cast<double>(state.range(5)) / 100;
  std::string reason;
  if (scene.device == Device::Cuda && !cudaAvailable(&reason))
  {
    state.SkipWithError(reason.c_str());
    return;
  }
  Bench bench;
  Image image = bench.render(column(state.range(0)).field, scene);
  double seconds = 0;
  for (auto _ : state)
  {
    ++scene.seed; // the medium stays, the rays are traced again
    image = bench.render(column(state.range(0)).field, scene);
    state.SetIterationTime(image.traceSeconds);
    seconds += image.traceSeconds;
  }
  report(state, image, seconds);
}

void traceArguments(benchmark::internal::Benchmark* b)
{
  b->ArgNames({ "n", "linear", "double", "device", "threads", "step%" });
  constexpr int cpu = static_cast<int>(Device::Cpu);
  constexpr int cuda = static_cast<int>(Device::Cuda);
  for (const int threads : { 1, 0 })
  {
    for (const int linear : { 0, 1 })
    {
      for (const int precise : { 0, 1 })
      {
        b->Args({ 256, linear, precise, cpu, threads, 100 });
      }
    }
  }
  for (const int n : { 32, 64, 128 }) // what a coarser grid costs in accuracy
  {
    b->Args({ n, 0, 0, cpu, 0, 100 });
    b->Args({ n, 1, 0, cpu, 0, 100 });
  }
  for (const int step : { 50, 200, 400 }) // and a longer step
  {
    b->Args({ 128, 0, 0, cpu, 0, step });
  }
  for (const int linear : { 0, 1 })
  {
    for (const int precise : { 0, 1 })
    {
      b->Args({ 256, linear, precise, cuda, 0, 100 });
    }
  }
}
BENCHMARK(trace)->Apply(traceArguments)->UseManualTime()->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
