// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The loop that takes rays through the medium: one ray where Real is a number (CUDA, and the CPU where
// there is nothing better), several side by side where it is a pack.
#pragma once

#include "Medium/FieldGradients.h"
#include "Medium/HomogeneityMap.h"
#include "Rays/Integrators.h"
#include "Rays/Light.h"
#include "Rays/RayExit.h"

#include <cstdint>
#include <type_traits>

namespace schlieren
{

/// Which kernel.
struct KernelChoice
{
  PathModel path; ///< not Auto
  Integrator integrator;
  Interpolation interpolation;
};

/// All that one ray needs, host and device alike.
template <class Number>
struct RayTask
{
  KernelChoice kernel;
  MediumView<Number> medium;
  HomogeneityView map; ///< levels null: no cube is skipped
  FieldGradientsView gradients;
  Light light;
  StraightLight<Number> straight;
  Number step; ///< in units of the light's unit of length
  std::int32_t stepLimit;
  double metresPerUnit; ///< of optical path: n_ref * length scale * unit of length
  bool bends;           ///< whether the path is refracted
  Number allowedBend;   ///< Adaptive: error of q allowed in a step, per unit of length
  Number allowedOffset; ///< Adaptive: the same of the offset
};

/// Rays in plain arrays: what the tracer hands to the marcher and gets back.
template <class Number, int Lanes>
struct RayBatch
{
  alignas(Lanes * sizeof(Number)) Number start[3][Lanes]; ///< within the grid
  Number q[3][Lanes];                                     ///< at the end, as all that follows
  Number offset[3][Lanes];
  Number length[Lanes];
  Number path[Lanes];
  Number pathError[Lanes];
  Number drift[Lanes]; ///< | |p| / n - 1 | at the end
  RayFate fate[Lanes]; ///< Left: to be traced; anything else: not
  std::int32_t steps[Lanes];
  float* gathered[Lanes]; ///< sums of the fields' gradients, where there are any
};

template <class Real, class Number>
SCHLIEREN_HD Real clampTo(const Real& x, const Number& last)
{
  // Written so that NaN becomes 0.
  const Real low = x > 0 ? x : Real{};
  return low < last ? low : Real{} + last;
}

template <class Real, class Number>
SCHLIEREN_HD Vec3<Real> clampTo(const Vec3<Real>& x, const Vec3<Number>& last)
{
  return { clampTo(x.x, last.x), clampTo(x.y, last.y), clampTo(x.z, last.z) };
}

/// How far inside the box [0, last] a place is, along the axis where that is least.
template <class Real, class Number>
SCHLIEREN_HD Real insetOf(const Vec3<Real>& x, const Vec3<Number>& last)
{
  const Real ofX = lesser<Real>(x.x, last.x - x.x);
  const Real ofY = lesser<Real>(x.y, last.y - x.y);
  const Real ofZ = lesser<Real>(x.z, last.z - x.z);
  return lesser(ofX, lesser(ofY, ofZ));
}

/// The way along a line from x to where it leaves the box [low, high] on one axis; negative if it has.
template <class Real, class Box>
SCHLIEREN_HD Real wayOut(const Real& x, const Real& along, const Box& low, const Box& high)
{
  const Real side = along > 0 ? Real{} + high : Real{} + low;
  const Real way = (side - x) / along;
  return along == 0 ? Real{} + infinite<NumberOf<Real>> : way;
}

template <class Real, class Box>
SCHLIEREN_HD Real wayOut(
  const Vec3<Real>& x, const Vec3<Real>& along, const Vec3<Box>& low, const Vec3<Box>& high)
{
  return lesser(wayOut(x.x, along.x, low.x, high.x),
    lesser(wayOut(x.y, along.y, low.y, high.y), wayOut(x.z, along.z, low.z, high.z)));
}

template <class Real>
SCHLIEREN_HD Vec3<NumberOf<Real>> laneOf(const Vec3<Real>& a, int i)
{
  return { lane(a.x, i), lane(a.y, i), lane(a.z, i) };
}

template <class Real>
SCHLIEREN_HD void setLaneOf(Vec3<Real>& a, int i, const Vec3<NumberOf<Real>>& to)
{
  setLane(a.x, i, to.x);
  setLane(a.y, i, to.y);
  setLane(a.z, i, to.z);
}

/// A function of its own where a step takes several samples: in line, their code would be too much.
template <class Scheme, class Real>
SCHLIEREN_APART Sample<Real> sampleApart(
  const MediumView<NumberOf<Real>>& medium, const Vec3<Real>& at)
{
  return interpolate<Scheme>(medium, at);
}

/// What the march of some rays through the medium needs to know, and its steps.
template <class Kernel, class Real>
struct March
{
  using Number = NumberOf<Real>;
  using Path = typename Kernel::Path;
  using Integrator = typename Kernel::Integrator;
  using Scheme = typename Kernel::Scheme;
  static constexpr int lanes = lanesOf<Real>;
  static constexpr bool isAdaptive = std::is_same_v<Integrator, Adaptive>;
  static constexpr bool isExact = Integrator::order > 2; ///< about where it leaves, too
  using Batch = RayBatch<Number, lanes>;

  const RayTask<Number>& task;
  Batch& batch;
  Ray<Real> ray;
  Real cruise;   ///< the usual step; 0 for rays that are not under way
  Real nextStep; ///< Adaptive: no longer than this
  int underWay = 0;

  SCHLIEREN_HD March(const RayTask<Number>& ofTask, Batch& ofBatch)
    : task(ofTask)
    , batch(ofBatch)
    , ray{}
    , cruise{}
    , nextStep(Real{} + ofTask.step)
  {
    for (int i = 0; i < lanes; ++i)
    {
      if (batch.fate[i] == RayFate::Left)
      {
        ++underWay;
        setLane(cruise, i, task.step);
        setLaneOf(ray.start, i, { batch.start[0][i], batch.start[1][i], batch.start[2][i] });
      }
      else
      {
        park(i);
      }
    }
    if constexpr (Path::bends)
    {
      // Light enters along w, so that |p| = 1 + nu from the start.
      ray.q = sample(ray.start).value * task.straight.w;
    }
  }

  /// Puts a ray where it disturbs no others.
  SCHLIEREN_HD void park(int i)
  {
    setLane(cruise, i, Number(0));
    setLaneOf(ray.start, i, Number(0.5) * task.medium.last);
    setLaneOf(ray.offset, i, Vec3<Number>{ 0, 0, 0 });
    setLaneOf(ray.q, i, Vec3<Number>{ 0, 0, 0 });
    setLane(ray.length, i, Number(0));
  }

  SCHLIEREN_HD bool isUnderWay(int i) const { return lane(cruise, i) > 0; }

  SCHLIEREN_HD void finish(int i, RayFate fate, std::int32_t steps)
  {
    const Vec3<Number> offset = laneOf(ray.offset, i);
    const Vec3<Number> q = laneOf(ray.q, i);
    batch.offset[0][i] = offset.x;
    batch.offset[1][i] = offset.y;
    batch.offset[2][i] = offset.z;
    batch.q[0][i] = q.x;
    batch.q[1][i] = q.y;
    batch.q[2][i] = q.z;
    batch.length[i] = lane(ray.length, i);
    batch.path[i] = lane(ray.path, i);
    batch.pathError[i] = lane(ray.pathError, i);
    batch.fate[i] = fate;
    batch.steps[i] = steps;
    park(i);
    --underWay;
  }

  /// Up to the far side of the homogeneous cubes that the rays are in, where that is further.
  SCHLIEREN_HD bool lengthen(Real& step, const Vec3<Real>& x, const Vec3<Real>& along) const
  {
    Vec3<Real> low{}, high{};
    bool found = false;
    for (int i = 0; i < lanes; ++i)
    {
      if (isUnderWay(i))
      {
        const HomogeneousCube<Number> cube =
          homogeneousCube(task.map, clampTo(laneOf(x, i), task.medium.last));
        found |= cube.edge > 0;
        setLaneOf(low, i, cube.low);
        setLaneOf(high, i, cube.low + Vec3<Number>{ cube.edge, cube.edge, cube.edge });
      }
    }
    if (found)
    {
      const Real far = wayOut(x, along, low, high);
      // Where there is no cube, low and high are 0 and say nothing.
      const Real toFarSide = high.x > low.x ? far : Real{};
      step = cruise > 0 ? greater(step, toFarSide) : step;
    }
    return found;
  }

  SCHLIEREN_HD void stopInSolids(Real& step, const Vec3<Real>& middle, std::int32_t steps)
  {
    for (int i = 0; i < lanes; ++i)
    {
      if (isUnderWay(i) && isSolid(task.medium, laneOf(middle, i)))
      {
        finish(i, RayFate::Blocked, steps);
        setLane(step, i, Number(0));
      }
    }
  }

  SCHLIEREN_HD void gather(const Vec3<Real>& middle, const Real& step) const
  {
    for (int i = 0; i < lanes; ++i)
    {
      if (isUnderWay(i))
      {
        gatherGradients(task.gradients, laneOf(middle, i), lane(step, i), batch.gathered[i]);
      }
    }
  }

  SCHLIEREN_HD Sample<Real> sample(const Vec3<Real>& at) const
  {
    const Vec3<Real> within = clampTo(at, task.medium.last);
    if constexpr (Integrator::samplesBeyond)
    {
      return sampleApart<Scheme>(task.medium, within);
    }
    else
    {
      return interpolate<Scheme>(task.medium, within);
    }
  }

  /// The rays after a step, and (Adaptive) its error by what is allowed.
  SCHLIEREN_HD Ray<Real> moved(const Real& step, const Vec3<Real>& middle, Real& error) const
  {
    if constexpr (isAdaptive)
    {
      const auto trial = Adaptive::attempt<Path>(
        ray, task.straight, step, [this](const Vec3<Real>& at) { return sample(at); });
      const Real q = dot(trial.qError, trial.qError);
      const Real offset = dot(trial.offsetError, trial.offsetError);
      const Number byBend = 1 / (task.allowedBend * task.allowedBend);
      const Number byOffset = 1 / (task.allowedOffset * task.allowedOffset);
      error = greater<Real>(byBend * q, byOffset * offset);
      error = step > 0 ? error / (step * step) : error; // its square, for all of the above
      return trial.ray;
    }
    else
    {
      Ray<Real> there = ray;
      Integrator::template advance<Path>(
        there, task.straight, step, middle, [this](const Vec3<Real>& at) { return sample(at); });
      return there;
    }
  }

  /// The step that ends where the rays leave the grid, of those that do: Newton's method on all of it,
  /// because a straight line to the grid's side would leave an error of second order.
  template <class Mask>
  SCHLIEREN_HD Real endingOutside(
    Real step, const Mask& leaving, const Vec3<Real>& x, const Vec3<Real>& along) const
  {
    constexpr int iterations = 3;
    for (int iteration = 0; iteration < iterations; ++iteration)
    {
      Real error{};
      const Ray<Real> there = moved(step, x + (Number(0.5) * step) * along, error);
      const Real rest = wayOut(Path::position(there, task.straight),
        Path::along(there, task.straight), Vec3<Number>{ 0, 0, 0 }, task.medium.last);
      step = leaving ? clampTo(step + rest, 2 * task.step) : step;
    }
    return step;
  }

  /// Adaptive: takes the steps whose error is allowed and chooses the next ones.
  SCHLIEREN_HD auto takeIfGood(const Ray<Real>& there, const Real& step, const Real& error)
  {
    const Real shortest = Real{} + task.step * Number(1. / 4096);
    const auto good = (error <= 1) | (step <= shortest);
    takeWhere(good, there);
    // The error of a step of the second order, which is what is compared, goes by its cube.
    const Real factor = Number(0.9) / squareRoot(squareRoot(error));
    const Real kept = factor > Number(0.2) ? factor : Real{} + Number(0.2);
    nextStep = greater<Real>(shortest, step * (kept < 4 ? kept : Real{} + 4));
    return good;
  }

  template <class Mask>
  SCHLIEREN_HD void takeWhere(const Mask& good, const Ray<Real>& there)
  {
    ray.offset.x = good ? there.offset.x : ray.offset.x;
    ray.offset.y = good ? there.offset.y : ray.offset.y;
    ray.offset.z = good ? there.offset.z : ray.offset.z;
    ray.q.x = good ? there.q.x : ray.q.x;
    ray.q.y = good ? there.q.y : ray.q.y;
    ray.q.z = good ? there.q.z : ray.q.z;
    ray.length = good ? there.length : ray.length;
    ray.path = good ? there.path : ray.path;
    ray.pathError = good ? there.pathError : ray.pathError;
  }

  template <class Mask>
  SCHLIEREN_HD void finishOutside(const Mask& leaving, std::int32_t steps)
  {
    // Of a step: nearer to the grid's side than this is there.
    constexpr double near = isExact && std::is_same_v<Number, double> ? 1e-9 : 1e-3;
    const Real rest = wayOut(Path::position(ray, task.straight), Path::along(ray, task.straight),
      Vec3<Number>{ 0, 0, 0 }, task.medium.last);
    for (int i = 0; i < lanes; ++i)
    {
      if (isUnderWay(i) && lane(leaving, i) && !(lane(rest, i) > Number(near) * task.step))
      {
        finish(i, RayFate::Left, steps);
      }
    }
  }

  /// How far | |p| / n - 1 | is from 0 at the end, which nothing in the integration forces it to be.
  SCHLIEREN_HD void findDrift()
  {
    Vec3<Real> at{}, q{};
    for (int i = 0; i < lanes; ++i)
    {
      setLaneOf(at, i,
        Vec3<Number>{ batch.start[0][i], batch.start[1][i], batch.start[2][i] } +
          batch.length[i] * task.straight.perLength +
          Vec3<Number>{ batch.offset[0][i], batch.offset[1][i], batch.offset[2][i] });
      setLaneOf(q, i, { batch.q[0][i], batch.q[1][i], batch.q[2][i] });
    }
    const Real nu = sample(at).value;
    const Real n = 1 + nu;
    const Real drift = (2 * (dot(q, task.straight.w) - nu) + dot(q, q) - nu * nu) / (2 * n * n);
    for (int i = 0; i < lanes; ++i)
    {
      const Number one = lane(drift, i);
      batch.drift[i] = Path::bends && batch.fate[i] == RayFate::Left ? (one < 0 ? -one : one) : 0;
    }
  }

  SCHLIEREN_HD void run()
  {
    constexpr Vec3<Number> zero{ 0, 0, 0 };
    constexpr int stepsBetweenLooks = 3;
    std::int32_t nextLook = 0;
    for (std::int32_t steps = 0; underWay > 0; ++steps)
    {
      if (steps == task.stepLimit)
      {
        for (int i = 0; i < lanes; ++i)
        {
          if (isUnderWay(i))
          {
            finish(i, RayFate::Trapped, steps);
          }
        }
        break;
      }
      const Vec3<Real> x = Path::position(ray, task.straight);
      const Vec3<Real> along = Path::along(ray, task.straight);
      Real step = isAdaptive ? lesser(cruise, nextStep) : cruise;
      if (!isAdaptive && task.map.levels != nullptr && steps >= nextLook)
      {
        nextLook = steps + (lengthen(step, x, along) ? 1 : stepsBetweenLooks);
      }
      auto leaving = insetOf(x + step * along, task.medium.last) < 0;
      const bool someLeave = any(leaving);
      if (someLeave)
      {
        const Real out = lesser(step, wayOut(x, along, zero, task.medium.last));
        step = leaving ? (out > 0 ? out : Real{}) : step;
        if constexpr (isExact)
        {
          step = endingOutside(step, leaving, x, along);
        }
      }
      const Vec3<Real> middle = x + (Number(0.5) * step) * along;
      if (task.medium.solid != nullptr)
      {
        stopInSolids(step, clampTo(middle, task.medium.last), steps);
      }
      Real error{};
      const Ray<Real> there = moved(step, middle, error);
      if constexpr (isAdaptive)
      {
        leaving = leaving & takeIfGood(there, step, error);
      }
      else
      {
        ray = there;
      }
      if (task.gradients.count > 0)
      {
        gather(clampTo(middle, task.medium.last), step);
      }
      if (someLeave)
      {
        finishOutside(leaving, steps + 1);
      }
    }
    findDrift();
  }
};

/// Takes the rays of a batch through the medium.
template <class Kernel, class Real>
SCHLIEREN_HD void march(
  const RayTask<NumberOf<Real>>& task, RayBatch<NumberOf<Real>, lanesOf<Real>>& batch)
{
  March<Kernel, Real>(task, batch).run();
}

/// Calls visit with an object of the kernel's type.
template <class Visit>
auto visitKernel(const KernelChoice& choice, const Visit& visit)
{
  return visitScheme(choice.interpolation,
    [&](auto scheme)
    {
      using Scheme = decltype(scheme);
      if (choice.path == PathModel::Straight)
      {
        return visit(Kernel<StraightPath, Leapfrog, Scheme>{});
      }
      switch (choice.integrator)
      {
        case Integrator::Rk4:
          return visit(Kernel<RefractedPath, Rk4, Scheme>{});
        case Integrator::Adaptive:
          return visit(Kernel<RefractedPath, Adaptive, Scheme>{});
        case Integrator::Euler:
          return visit(Kernel<RefractedPath, Euler, Scheme>{});
        default:
          return visit(Kernel<RefractedPath, Leapfrog, Scheme>{});
      }
    });
}

} // namespace schlieren
