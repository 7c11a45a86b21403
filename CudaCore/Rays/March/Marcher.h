// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The steps that take rays through the medium.
#pragma once

#include "Rays/March/RaysInMedium.h"
#include "Rays/March/Walls.h"

#include <cstdint>
#include <limits>
#include <type_traits>

namespace schlieren
{

/// Relative, of a number.
template <class Number>
constexpr Number roundingOf = std::numeric_limits<Number>::epsilon();

/// The march of some rays through the medium.
template <class Kernel, class Real, class May = MayMeetAll>
struct March : RaysInMedium<Kernel, Real, May>
{
  using Base = RaysInMedium<Kernel, Real, May>;
  using Base::areUnderWay, Base::batch, Base::cruise, Base::domainHigh, Base::domainLow,
    Base::finish, Base::forRays, Base::in, Base::inGas, Base::isAdaptive, Base::isConstant,
    Base::isTree, Base::lanes, Base::light, Base::nextStep, Base::ray, Base::someConstant,
    Base::someNearEdge, Base::someNearEnd, Base::steps, Base::stepsInLeaves, Base::stepsToFirst,
    Base::stepsToLast, Base::takeLeaves, Base::task, Base::withinLeaf;
  using Base::Base;
  using typename Base::Batch, typename Base::Number, typename Base::Path, typename Base::Integrator;

  /// Shortens the usual step, which in leaves of one layer, or of flat voxels, may lead far beyond the domain.
  SCHLIEREN_HD Real stepWithinDomain() const
  {
    if (task.medium.planeStride != 0 && !task.mayCrossLeaves)
    {
      return cruise;
    }
    const Real out =
      wayOut(Path::position(ray, light), Path::along(ray, light), domainLow, domainHigh);
    return minimum(cruise, maximum(out, Real{}));
  }

  /// Sees to it that each ray is in the leaf of the middle of its next step, and returns the longest steps: as
  /// long as a voxel where that is; through a leaf where nothing changes, up to its far side.
  SCHLIEREN_HD Real settle()
  {
    Real step = cruise;
    const Real within = stepWithinDomain();
    const Vec3<Real> middle = Path::ahead(ray, light, Number(0.5) * within);
    const auto isOut =
      (insetOf(middle, task.medium.leafLow, task.medium.leafHigh) < 0) & (cruise > 0);
    if (any(isOut))
    {
      RaysBetweenLeaves<Real> rays{ isOut ? Real{} + 1 : Real{}, Path::position(ray, light),
        Path::along(ray, light), within, ray.start, ray.length, {} };
      if (changeLeaves(task.medium, stepsInLeaves(), batch.perLength, in, rays))
      {
        ray.start = rays.start;
        ray.length = rays.length;
        ray.offset = rays.finer * ray.offset;
        takeLeaves();
      }
      step = rays.step < within ? rays.step : step;
    }
    if (someConstant && !isAdaptive)
    {
      // A little beyond, so that the next leaf is found there. A ray that runs along a side of the leaf may be on
      // it for ever, by rounding: an axis on which it hardly moves does not count.
      const auto moved = [this](const Real& along)
      {
        const Real inAStep = along * cruise;
        return inAStep * inAStep < Number(1e-8) ? Real{} : along;
      };
      const Vec3<Real> along = Path::along(ray, light);
      const Real out = wayOut(Path::position(ray, light),
        Vec3<Real>{ moved(along.x), moved(along.y), moved(along.z) }, task.medium.leafLow,
        task.medium.leafHigh);
      const Real through = maximum(out, Real{}) + Number(1e-3) * cruise;
      step = (isConstant > 0) & (cruise > 0) ? through : step;
    }
    return step;
  }

  template <class Mask>
  SCHLIEREN_HD void block(const Mask& which, Real& step)
  {
    if (any(which))
    {
      finish(which, RayFate::Blocked, steps);
      step = which ? Real{} : step;
    }
  }

  /// Ends the rays that have come to a wall, and finds out which are where there is no gas.
  SCHLIEREN_HD void lookForEdges(Real& step, const Vec3<Real>& middle, const Vec3<Real>& half)
  {
    Real gas = inGas;
    const auto which = meetWalls(task.medium, in.leaf, middle, half, cruise, gas) > 0;
    inGas = gas;
    block(which, step);
  }

  SCHLIEREN_HD void stopInSolids(Real& step, const Vec3<Real>& middle)
  {
    Number blocked[lanes]{};
    forRays(middle, step,
      [&](int i, const Vec3<Number>& at, Number)
      { blocked[i] = isSolid(task.medium, at) ? 1 : 0; });
    const auto which = fromArray<Real>(blocked) > 0;
    block(which, step);
  }

  struct Sampler // a lambda cannot be forced to be compiled into its caller
  {
    const March& rays;
    SCHLIEREN_HD Sample<Real> operator()(const Vec3<Real>& at) const { return rays.sample(at); }
  };

  SCHLIEREN_HD void advance(Ray<Real>& there, const Real& step, const Vec3<Real>& middle) const
  {
    Integrator::template advance<Path>(there, light, step, middle, Sampler{ *this });
  }

  /// Adaptive: the rays after a step, and the square of its error by what is allowed.
  SCHLIEREN_HD Ray<Real> attempt(const Real& step, Real& error) const
  {
    const auto trial = Adaptive::attempt<Path>(ray, light, step, Sampler{ *this });
    // Scaled first: in a faint medium the square of what is allowed is no float.
    const auto squared = [](const Vec3<Real>& a) { return dot(a, a); };
    const Real perStep = step > 0 ? 1 / step : Real{};
    error = maximum(squared(perStep * ((1 / task.allowedBend) * trial.qError)),
      squared(perStep * ((1 / task.allowedOffset) * trial.offsetError)));
    return trial.ray;
  }

  /// Adaptive: the step that ends where the rays leave the grid, of those that do: Newton's method on all of it,
  /// because a straight line to the grid's side would leave an error of second order. `longest`: of a ray that turns
  /// back into the grid.
  template <class Mask>
  SCHLIEREN_HD Real endingOutside(Real step, const Real& longest, const Mask& leaving) const
  {
    constexpr int iterations = 3;
    for (int iteration = 0; iteration < iterations; ++iteration)
    {
      Real error{};
      const Ray<Real> there = attempt(step, error);
      const Real rest =
        wayOut(Path::position(there, light), Path::along(there, light), domainLow, domainHigh);
      // A parabola that meets the side does so behind half of the way to where its tangent does. Less is rounding, of
      // which the step may not become 0.
      const Real shortest = Number(0.5) * step;
      step = leaving ? minimum(maximum(step + rest, shortest), longest) : step;
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
    nextStep = maximum(shortest, step * (kept < 4 ? kept : Real{} + 4));
    return good;
  }

  template <class Mask>
  SCHLIEREN_HD void takeWhere(const Mask& good, const Ray<Real>& there)
  {
    ray.offset = either(good, there.offset, ray.offset);
    ray.q = either(good, there.q, ray.q);
    ray.length = good ? there.length : ray.length;
    ray.path = good ? there.path : ray.path;
    ray.pathError = good ? there.pathError : ray.pathError;
  }

  /// Finds those that have left the grid, of rays that may.
  template <class Mask>
  SCHLIEREN_HD Mask areOutside(const Mask& leaving) const
  {
    // Of a step: nearer to the grid's side than this is there.
    constexpr double near = isAdaptive && std::is_same_v<Number, double> ? 1e-9 : 1e-3;
    // Rounding of places counts, too: by that alone, a ray along the side may be far from where it leaves.
    const auto within = [](const Real& low, const Real& high, const Number& ofLeaf)
    { return roundingOf<Number> * minimum(high - low, Real{} + ofLeaf); };
    const Vec3<Number>& leaf = task.medium.leafHigh;
    const Vec3<Real> rounding{ within(domainLow.x, domainHigh.x, leaf.x),
      within(domainLow.y, domainHigh.y, leaf.y), within(domainLow.z, domainHigh.z, leaf.z) };
    const Real rest = wayOut(Path::position(ray, light), Path::along(ray, light),
      domainLow + rounding, domainHigh - rounding);
    return leaving & (cruise > 0) & (rest <= Number(near) * cruise);
  }

  /// How many steps the rays can take before any of them can reach its leaf's side.
  SCHLIEREN_HD std::int32_t stepsInside() const
  {
    const Vec3<Real> x = Path::position(ray, light);
    // A leaf of one layer reaches beyond the domain.
    Vec3<Real> low = Vec3<Real>{} + task.medium.leafLow, high = Vec3<Real>{} + task.medium.leafHigh;
    low.z = maximum(low.z, domainLow.z);
    high.z = minimum(high.z, domainHigh.z);
    const Real least =
      minimum(leastOf(scaled(high - x, stepsToLast)), leastOf(scaled(x - low, stepsToFirst)));
    Number most[lanes];
    toArray(least, most);
    const std::int32_t left = task.stepLimit - steps;
    auto all = static_cast<Number>(left);
    for (const Number one : most)
    {
      all = minimum(one, all);
    }
    // An estimate, of any size.
    return !(all > 0) ? 0 : all < static_cast<Number>(left) ? static_cast<std::int32_t>(all) : left;
  }

  /// Whether rays meet nothing but the medium's samples.
  SCHLIEREN_HD bool isPlain() const
  {
    return !someConstant && !someNearEdge && task.medium.solid == nullptr;
  }

  /// The next step of the rays that are under way.
  struct NextStep
  {
    Real step;
    Vec3<Real> middle;
    decltype(Real{} < Real{}) leaving; ///< rays that may end with it
    bool someLeave;
  };

  /// Finds the step of rays of which none leaves its leaf, with nothing to look at but the medium.
  SCHLIEREN_HD NextStep stepInside() const
  {
    return { cruise, Path::ahead(ray, light, Number(0.5) * cruise), cruise < cruise, false };
  }

  /// Looks at all that a ray may meet.
  SCHLIEREN_HD NextStep chooseStep()
  {
    const Real usual = isTree() ? settle() : cruise;
    const Vec3<Real> x = Path::position(ray, light);
    const Vec3<Real> along = Path::along(ray, light);
    NextStep next{ isAdaptive ? minimum(usual, nextStep) : usual, x, usual < usual, false };
    Real& step = next.step;
    next.leaving = insetOf(x + step * along, domainLow, domainHigh) < 0;
    next.someLeave = any(next.leaving);
    if (next.someLeave)
    {
      const Real longest = 2 * step;
      const Real out = minimum(step, wayOut(x, along, domainLow, domainHigh));
      step = next.leaving ? (out > 0 ? out : Real{}) : step;
      if constexpr (isAdaptive)
      {
        step = endingOutside(step, longest, next.leaving);
      }
    }
    next.middle = x + (Number(0.5) * step) * along;
    if (May::anImage && task.medium.solid != nullptr)
    {
      stopInSolids(step, clampTo(next.middle, task.medium.leafHigh));
      areUnderWay = any(cruise > 0);
    }
    if (someNearEdge)
    {
      lookForEdges(step, withinLeaf(next.middle), (Number(0.5) * step) * along);
      areUnderWay = any(cruise > 0);
    }
    return next;
  }

  SCHLIEREN_HD void take(NextStep next)
  {
    if constexpr (isAdaptive)
    {
      Real error{};
      const Ray<Real> there = attempt(next.step, error);
      const auto good = takeIfGood(there, next.step, error);
      next.leaving = next.leaving & good;
      next.step = good ? next.step : Real{};
    }
    else
    {
      advance(ray, next.step, next.middle);
    }
    if (next.someLeave)
    {
      const auto done = areOutside(next.leaving);
      if (any(done))
      {
        finish(done, RayFate::Left, steps + 1);
      }
      areUnderWay = any(cruise > 0);
    }
    ++steps;
  }

  /// One step of all rays that are under way.
  SCHLIEREN_NOINLINE void takeStep()
  {
    if (isTrapped())
    {
      return;
    }
    take(chooseStep());
  }

  /// Ends the rays that have taken too many steps.
  SCHLIEREN_HD bool isTrapped()
  {
    if (steps < task.stepLimit)
    {
      return false;
    }
    finish(cruise > 0, RayFate::Trapped, steps);
    areUnderWay = false;
    return true;
  }

  /// Takes all steps. There is one piece of code for a step, whether there is anything to look at or not: on a GPU,
  /// rays that look and rays that do not continue together.
  SCHLIEREN_HD void takeAllSteps()
  {
    std::int32_t inside = 0;
    while (areUnderWay && (inside > 0 || !isTrapped()))
    {
      take(inside > 0 ? stepInside() : chooseStep());
      --inside;
      if (!isAdaptive && inside < 0)
      {
        inside = isPlain() ? stepsInside() : 0;
      }
    }
  }
};

/// Takes the rays of a batch through the medium.
template <class Kernel, class Real, class May = MayMeetAll>
SCHLIEREN_HD void march(
  const RayTask<NumberOf<Real>>& task, RayBatch<NumberOf<Real>, lanesOf<Real>>& batch)
{
  March<Kernel, Real, May> rays(task, batch);
  rays.takeAllSteps();
  rays.findDrift();
}

} // namespace schlieren
