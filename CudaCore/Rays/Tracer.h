// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/FieldGradients.h"
#include "Medium/Medium.h"
#include "Rays/Integrators.h"
#include "Rays/Light.h"
#include "Rays/RayExit.h"

#include <vector>

namespace schlieren
{

/// A ray that has taken this many times the steps of a straight one is trapped.
constexpr int trappedFactor = 8;

/// All that one ray needs, host and device alike.
template <class Real>
struct RayTask
{
  MediumView<Real> medium;
  Light light;
  StraightLight<Real> straight;
  Real step; ///< in units of the light's unit of length
  std::int32_t stepLimit;
  double metresPerUnit; ///< of optical path: n_ref * length scale * unit of length
};

/// What a ray does besides in each step: nothing, or gather the gradients of fields.
struct GatherNothing
{
  template <class Real>
  SCHLIEREN_HD void operator()(const Vec3<Real>&, Real) const
  {
  }
};
struct GatherFields
{
  FieldGradientsView view;
  float* sums;

  template <class Real>
  SCHLIEREN_HD void operator()(const Vec3<Real>& middle, Real step) const
  {
    gatherGradients(view, middle, step, sums);
  }
};

/// The piece of the line start + s * along, s >= 0, inside the box [0, last]; empty if from > to.
struct Chord
{
  double from, to;
};

SCHLIEREN_HD inline void clip(Chord& chord, double start, double along, double last)
{
  if (along == 0)
  {
    if (start < 0 || start > last)
    {
      chord.to = -1;
    }
    return;
  }
  const double a = (0 - start) / along;
  const double b = (last - start) / along;
  chord.from = fmax(chord.from, fmin(a, b));
  chord.to = fmin(chord.to, fmax(a, b));
}

template <class Real>
SCHLIEREN_HD Real clampTo(Real x, Real last)
{
  // Written so that NaN becomes 0.
  return x > 0 ? (x < last ? x : last) : Real(0);
}

template <class Real>
SCHLIEREN_HD Vec3<Real> clampTo(const Vec3<Real>& x, const Vec3<Real>& last)
{
  return { clampTo(x.x, last.x), clampTo(x.y, last.y), clampTo(x.z, last.z) };
}

/// Whether x + step * along leaves [0, last]; if so, the step that just reaches its side.
template <class Real>
SCHLIEREN_HD bool shortenToLeave(Real& step, Real x, Real along, Real last)
{
  const Real next = x + step * along;
  if (next >= 0 && next <= last)
  {
    return false;
  }
  const Real toSide = ((along > 0 ? last : Real(0)) - x) / along;
  step = toSide > 0 ? (toSide < step ? toSide : step) : Real(0);
  return true;
}

/// Traces the ray that starts at (column, row) of the picture, in pixels from the centre of pixel
/// (0, 0), through the medium and on to the exit plane.
template <class Interpolate, class Real, class Gather = GatherNothing>
SCHLIEREN_HD RayExit traceRay(
  const RayTask<Real>& task, double column, double row, const Gather& gather = {})
{
  RayExit exit{ { 0, 0 }, { 0, 0 }, 0, RayFate::Missed, 0 };
  const Vec3<double> start = task.light.start(column, row);
  const Vec3<double> last = static_cast<Vec3<double>>(task.medium.last);
  Chord chord{ 0, task.light.depth };
  clip(chord, start.x, task.light.perLength.x, last.x);
  clip(chord, start.y, task.light.perLength.y, last.y);
  clip(chord, start.z, task.light.perLength.z, last.z);
  if (!(chord.from < chord.to))
  {
    return exit;
  }

  Ray<Real> ray;
  ray.start =
    clampTo(static_cast<Vec3<Real>>(start + chord.from * task.light.perLength), task.medium.last);
  // Where it enters and leaves, too: the steps' midpoints do not look at the grid's faces.
  const auto isBlockedAt = [&task](const Vec3<Real>& at)
  { return task.medium.solid != nullptr && isSolid(task.medium, at); };
  if (isBlockedAt(ray.start))
  {
    exit.fate = RayFate::Blocked;
    return exit;
  }
  // Light enters along w, so that |p| = 1 + nu from the start.
  ray.q = interpolate<Interpolate>(task.medium, ray.start).value * task.straight.w;

  double path = 0;
  bool leaving = false;
  while (!leaving)
  {
    if (exit.steps == task.stepLimit)
    {
      exit.fate = RayFate::Trapped;
      return exit;
    }
    const Vec3<Real> x = ray.start + ray.length * task.straight.perLength + ray.offset;
    const Vec3<Real> along = task.straight.perLength + scaled(task.straight.indexScale, ray.q);
    Real step = task.step;
    leaving = shortenToLeave(step, x.x, along.x, task.medium.last.x);
    leaving = shortenToLeave(step, x.y, along.y, task.medium.last.y) || leaving;
    leaving = shortenToLeave(step, x.z, along.z, task.medium.last.z) || leaving;

    const Vec3<Real> middle =
      clampTo(Leapfrog::midpoint(ray, task.straight, step), task.medium.last);
    if (isBlockedAt(middle))
    {
      exit.fate = RayFate::Blocked;
      return exit;
    }
    path +=
      Leapfrog::advance(ray, task.straight, step, interpolate<Interpolate>(task.medium, middle));
    gather(middle, step);
    ++exit.steps;
  }
  if (isBlockedAt(
        clampTo(ray.start + ray.length * task.straight.perLength + ray.offset, task.medium.last)))
  {
    exit.fate = RayFate::Blocked;
    return exit;
  }

  const Vec3<double> q = static_cast<Vec3<double>>(ray.q);
  const double forward = 1 + dot(q, task.light.w);
  if (!(forward > 0))
  {
    exit.fate = RayFate::Turned;
    return exit;
  }
  const double alongU = dot(q, task.light.u);
  const double alongV = dot(q, task.light.v);
  const double momentum = std::sqrt(alongU * alongU + alongV * alongV + forward * forward);
  exit.fate = RayFate::Left;
  exit.deflection[0] = alongU / momentum;
  exit.deflection[1] = alongV / momentum;
  exit.opticalPathDifference = path * task.metresPerUnit;

  // From where it leaves the grid, straight on to the exit plane.
  const Vec3<double> offset = { static_cast<double>(ray.offset.x) / task.light.indexScale.x,
    static_cast<double>(ray.offset.y) / task.light.indexScale.y,
    static_cast<double>(ray.offset.z) / task.light.indexScale.z };
  const double remaining =
    task.light.depth - chord.from - static_cast<double>(ray.length) - dot(offset, task.light.w);
  exit.displacement[0] =
    (dot(offset, task.light.u) + remaining * alongU / forward) * task.light.unit;
  exit.displacement[1] =
    (dot(offset, task.light.v) + remaining * alongV / forward) * task.light.unit;
  return exit;
}

template <class Real>
RayTask<Real> makeTask(
  const Medium<Real>& medium, const Light& light, double stepVoxels, double lengthScale);

/// The furthest that any ray is displaced sideways on the exit plane, and its largest slope there;
/// infinite where no bound is known. From |dq/ds| <= (1 + nu) |grad nu| with the medium's largest
/// values, for a ray that goes through all of the grid's depth.
struct DisplacementBound
{
  double displacement; ///< data units
  double slope;
};
template <class Real>
DisplacementBound boundDisplacement(const Medium<Real>& medium, const Light& light);

/// The rays of a pass, row by row, and what each has gathered of each field's gradient: its integral
/// over the ray, a number without unit. Nothing where the view has no fields.
struct TracedPass
{
  std::vector<RayExit> exits;
  std::vector<float> gathered;

  void resize(const Pass& pass, int fields)
  {
    const auto rays = static_cast<std::size_t>(pass.columns * pass.rows);
    exits.resize(rays);
    gathered.assign(rays * static_cast<std::size_t>(fields), 0);
  }
  std::size_t bytes() const
  {
    return exits.size() * sizeof(RayExit) + gathered.size() * sizeof(float);
  }
};

/// Traces a pass on the CPU into `traced`, which has its size. Returns false if aborted.
template <class Real>
bool traceOnCpu(const RayTask<Real>& task, Interpolation interpolation, const Pass& pass,
  const FieldGradientsView& gradients, TracedPass& traced, int threads, const Monitor& monitor);

} // namespace schlieren
