// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/Tracer.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace schlieren
{

template <class Real>
RayTask<Real> makeTask(
  const Medium<Real>& medium, const Light& light, double stepVoxels, double lengthScale)
{
  RayTask<Real> task{};
  task.medium = medium.view();
  task.light = light;
  task.straight = { static_cast<Vec3<Real>>(light.w), static_cast<Vec3<Real>>(light.perLength),
    static_cast<Vec3<Real>>(light.indexScale) };
  const double step = stepVoxels / length(light.perLength);
  task.step = static_cast<Real>(step);
  const double straightSteps = std::ceil(light.depth / step) + 1;
  constexpr double largestLimit = std::numeric_limits<std::int32_t>::max();
  task.stepLimit = static_cast<std::int32_t>(std::min(trappedFactor * straightSteps, largestLimit));
  task.metresPerUnit = (1 + medium.ambient) * lengthScale * light.unit;
  return task;
}

template <class Real>
DisplacementBound boundDisplacement(const Medium<Real>& medium, const Light& light)
{
  const double steepest = length(scaled(medium.slope, light.indexScale));
  const double bend = (1 + medium.largestNu) * steepest;
  if (bend == 0)
  {
    return { 0, 0 };
  }
  // The way s after which the ray has advanced by the depth at the latest: (1 - nu) s - bend s^2 / 2.
  const double forward = 1 - medium.largestNu;
  const double discriminant = forward * forward - 2 * bend * light.depth;
  if (!(forward > 0) || !(discriminant > 0))
  {
    return { std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity() };
  }
  const double way = 2 * light.depth / (forward + std::sqrt(discriminant));
  return { 0.5 * bend * way * way * light.unit, bend * way / (forward - bend * way) };
}

template <class Interpolate, class Real>
bool traceBy(const RayTask<Real>& task, const Pass& pass, const FieldGradientsView& gradients,
  TracedPass& traced, int threads, const Monitor& monitor)
{
  const auto traceRays = [&](std::int64_t begin, std::int64_t end, const auto& gatherOf)
  {
    for (std::int64_t ray = begin; ray < end; ++ray)
    {
      traced.exits[static_cast<std::size_t>(ray)] =
        traceRay<Interpolate>(task, pass.columnOf(ray), pass.rowOf(ray), gatherOf(ray));
    }
  };
  constexpr std::int64_t raysPerPiece = 128;
  return parallelFor(
    pass.columns * pass.rows, raysPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      if (gradients.count == 0)
      {
        traceRays(begin, end, [](std::int64_t) { return GatherNothing{}; });
      }
      else
      {
        float* sums = traced.gathered.data();
        traceRays(begin, end,
          [&](std::int64_t ray) {
            return GatherFields{ gradients, sums + ray * gradients.count };
          });
      }
    },
    monitor);
}

template <class Real>
bool traceOnCpu(const RayTask<Real>& task, Interpolation interpolation, const Pass& pass,
  const FieldGradientsView& gradients, TracedPass& traced, int threads, const Monitor& monitor)
{
  return interpolation == Interpolation::Quadratic
    ? traceBy<QuadraticInterpolation>(task, pass, gradients, traced, threads, monitor)
    : traceBy<LinearInterpolation>(task, pass, gradients, traced, threads, monitor);
}

template RayTask<float> makeTask(const Medium<float>&, const Light&, double, double);
template RayTask<double> makeTask(const Medium<double>&, const Light&, double, double);
template DisplacementBound boundDisplacement(const Medium<float>&, const Light&);
template DisplacementBound boundDisplacement(const Medium<double>&, const Light&);
template bool traceOnCpu(const RayTask<float>&, Interpolation, const Pass&,
  const FieldGradientsView&, TracedPass&, int, const Monitor&);
template bool traceOnCpu(const RayTask<double>&, Interpolation, const Pass&,
  const FieldGradientsView&, TracedPass&, int, const Monitor&);

} // namespace schlieren
