// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// How many images a second of an instrument under one's hands: a new knife edge, a new camera. 512 x 512
// pixels; the time of each stage apart.
#include "Schlieren.h"
#include "TimedImages.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

namespace
{

using namespace schlieren;

/// A plume with a wavy edge in a quarter of a cube, in uniform gas.
struct Plume
{
  explicit Plume(std::int64_t n)
  {
    field.grid.dimensions = { n, n, n };
    const double h = 2 / static_cast<double>(n - 1);
    field.grid.spacing = { h, h, h };
    field.grid.origin = { -1, -1, -1 };
    field.version = static_cast<std::uint64_t>(n);
    samples.reserve(static_cast<std::size_t>(n * n * n));
    const auto coordinate = [h](std::int64_t i) { return h * static_cast<double>(i) - 1; };
    for (std::int64_t k = 0; k < n; ++k)
    {
      for (std::int64_t j = 0; j < n; ++j)
      {
        for (std::int64_t i = 0; i < n; ++i)
        {
          const double x = coordinate(i), y = coordinate(j), z = coordinate(k);
          const double edge =
            0.4 + 0.1 * y + 0.05 * std::sin(12 * y + 3 * std::atan2(z, x)) - std::hypot(x, z);
          samples.push_back(static_cast<float>(2.7e-4 - 1e-4 / (1 + std::exp(-40 * edge))));
        }
      }
    }
    field.singles = samples.data();
  }

  Field field;
  std::vector<float> samples;
};

const Field& plume(std::int64_t n)
{
  static std::map<std::int64_t, std::unique_ptr<Plume>> made;
  std::unique_ptr<Plume>& one = made[n];
  if (!one)
  {
    one = std::make_unique<Plume>(n);
  }
  return one->field;
}

/// The preset `Interactive`.
Scene interactive()
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.viewDirection = { -0.3, 0.1, -1 };
  scene.samplesPerPixel = 1;
  scene.stepSize = 2;
  scene.homogeneityTolerance = 1e-3;
  return scene;
}

/// Renders what `change` makes of the scene, image after image.
template <class Change>
void renderAgain(benchmark::State& state, const Field& field, Scene scene, const Change& change)
{
  Bench bench;
  bench.render(field, scene);
  timeImages(state,
    [&]
    {
      change(scene);
      const Image image = bench.render(field, scene);
      benchmark::DoNotOptimize(image.intensity.data());
      return image.traceSeconds;
    });
}

FilmEstimator estimatorOf(const benchmark::State& state, std::size_t argument)
{
  return state.range(argument) == 1 ? FilmEstimator::Sheet : FilmEstimator::Photon;
}

/// Cached rays meet another knife edge, nothing is traced.
void shadeAgain(benchmark::State& state)
{
  Scene scene = interactive();
  scene.samplesPerPixel = static_cast<int>(state.range(0));
  scene.threads = static_cast<int>(state.range(1));
  scene.filmEstimator = estimatorOf(state, 2);
  renderAgain(state, plume(64), scene, [](Scene& next) { next.knifeEdgeAngle += 1; });
}
BENCHMARK(shadeAgain)
  ->ArgNames({ "samples", "threads", "sheet" })
  ->ArgsProduct({ { 1, 4 }, { 1, 2 }, { 0, 1 } })
  ->MeasureProcessCPUTime()
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

/// A shadowgraph's screen is moved, so many depths of the data away, nothing is traced.
void moveScreen(benchmark::State& state)
{
  Scene scene = interactive();
  scene.cutoff = Cutoff::Shadowgraph;
  scene.threads = static_cast<int>(state.range(1));
  scene.filmEstimator = estimatorOf(state, 2);
  scene.screenDistance = 2 * static_cast<double>(state.range(0));
  renderAgain(state, plume(64), scene, [](Scene& next) { *next.screenDistance *= 1 + 1e-3; });
}
BENCHMARK(moveScreen)
  ->ArgNames({ "depths", "threads", "sheet" })
  ->ArgsProduct({ { 1, 30, 300, 3000 }, { 1 }, { 0, 1 } })
  ->MeasureProcessCPUTime()
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

/// The camera goes round the medium, three degrees an image.
void newCamera(benchmark::State& state)
{
  Scene scene = interactive();
  scene.threads = static_cast<int>(state.range(1));
  double angle = 0;
  renderAgain(state, plume(state.range(0)), scene,
    [&angle](Scene& next)
    {
      angle += 3 * std::acos(-1.) / 180;
      next.view.viewDirection = { -std::sin(angle), -0.3, -std::cos(angle) };
    });
}
BENCHMARK(newCamera)
  ->ArgNames({ "n", "threads" })
  ->ArgsProduct({ { 256 }, { 1, 2 } })
  ->Iterations(10)
  ->MeasureProcessCPUTime()
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
