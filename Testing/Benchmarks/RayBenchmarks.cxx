// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How many steps and rays a second the marcher takes: by integrator, interpolation, precision, path model,
// instructions, threads and direction of view, deflection and optical path difference both summed.
// 512^2 rays that fit the grid into the image; all figures by the clock.
#include "Medium/Medium.h"
#include "Rays/Cpu/CpuTracer.h"
#include "Rays/March/MakeTask.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
#include <vector>

namespace
{

using namespace schlieren;

constexpr std::int64_t edge = 256;

/// A blob without symmetry to the grid, in a quarter of which next to nothing varies.
const Field& blob()
{
  static std::vector<float> samples;
  static Field field;
  if (samples.empty())
  {
    samples.reserve(edge * edge * edge);
    for (std::int64_t k = 0; k < edge; ++k)
    {
      for (std::int64_t j = 0; j < edge; ++j)
      {
        for (std::int64_t i = 0; i < edge; ++i)
        {
          const double x = (static_cast<double>(i) - 120) / 32;
          const double y = (static_cast<double>(j) - 130) / 58;
          const double z = (static_cast<double>(k) - 125) / 45;
          samples.push_back(static_cast<float>(1e-4 * std::exp(-x * x - y * y - z * z)));
        }
      }
    }
    field.grid.dimensions = { edge, edge, edge };
    field.singles = samples.data();
    field.ambient = 0;
  }
  return field;
}

template <class Real>
const Medium<Real>& mediumFor(Interpolation interpolation)
{
  static std::unique_ptr<Medium<Real>> cached;
  static Interpolation cachedFor;
  if (!cached || cachedFor != interpolation)
  {
    cached.reset();
    cached = std::make_unique<Medium<Real>>(buildMedium<Real>(blob(), interpolation, 0));
    cachedFor = interpolation;
  }
  return *cached;
}

enum Direction
{
  AlongZ,
  AlongX,
  Oblique,
  Diagonal
};

Vector directionOf(std::int64_t direction)
{
  switch (direction)
  {
    case AlongZ:
      return { 0, 0, -1 };
    case AlongX:
      return { -1, 0, 0 };
    case Oblique:
      return { -0.8, 0.3, -0.6 };
    default:
      return { -1, -1, -1 };
  }
}

template <class Real>
void march(benchmark::State& state, const RaySettings& settings)
{
  const auto simd = static_cast<Simd>(state.range(4));
  if (!hasSimd(simd))
  {
    state.SkipWithError("this processor has no such instructions");
    return;
  }
  const Medium<Real>& medium = mediumFor<Real>(settings.kernel.interpolation);
  View view;
  view.viewDirection = directionOf(state.range(6));
  const Light light = collimatedLight(blob().grid, frameOf(blob().grid, view));
  const RayTask<Real> task = makeTask<Real>(medium, light, settings);
  const Pass pass{ 0, 0, view.width, view.height, { 0, 0 } };
  TracedPass traced;
  traced.resize(pass);
  for (auto _ : state)
  {
    traceOnCpu(task, pass, traced, static_cast<int>(state.range(5)), {}, simd);
  }
  double steps = 0, rays = 0;
  for (const RayExit& exit : traced.exits)
  {
    steps += exit.steps;
    rays += exit.steps > 0 ? 1 : 0;
  }
  using benchmark::Counter;
  state.counters["steps/s"] = Counter(steps, Counter::kIsIterationInvariantRate);
  state.counters["rays/s"] = Counter(rays, Counter::kIsIterationInvariantRate);
}

void rays(benchmark::State& state)
{
  RaySettings settings;
  settings.kernel = { static_cast<PathModel>(state.range(2)),
    static_cast<Integrator>(state.range(1)), static_cast<Interpolation>(state.range(0)) };
  state.range(3) == 0 ? march<float>(state, settings) : march<double>(state, settings);
}

void arguments(benchmark::internal::Benchmark* b)
{
  b->ArgNames({ "interpolation", "integrator", "path", "double", "simd", "threads", "view" });
  constexpr int refracted = static_cast<int>(PathModel::Refracted);
  constexpr int straight = static_cast<int>(PathModel::Straight);
  const int best = static_cast<int>(bestSimd());
  for (const int interpolation :
    { 0, 1 }) // Quadratic, Cubic: the rate and its ratio to one ray at a time
  {
    for (const int simd : { 0, 1, 2, 3 })
    {
      b->Args({ interpolation, 0, refracted, 0, simd, 2, Oblique });
    }
    for (const int view : { AlongZ, AlongX, Diagonal })
    {
      b->Args({ interpolation, 0, refracted, 0, best, 2, view });
    }
    b->Args({ interpolation, 0, refracted, 0, best, 1, Oblique });
    b->Args({ interpolation, 0, straight, 0, best, 2, Oblique });
  }
  b->Args({ 0, 1, refracted, 0, best, 2, Oblique }); // Adaptive
  for (const int interpolation : { 0, 1 })
  {
    b->Args({ interpolation, 0, refracted, 1, best, 2, Oblique });
  }
  b->Args({ 1, 1, refracted, 1, best, 2, Oblique }); // as the Reference preset
}
BENCHMARK(rays)->Apply(arguments)->UseRealTime()->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
