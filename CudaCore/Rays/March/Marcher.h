// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The loop that takes rays through the medium: one ray where Real is a number (CUDA, and the CPU where
// there is nothing better), several side by side where it is a pack.
#pragma once

#include "Rays/March/InBoxes.h"
#include "Rays/March/LeavesOfRays.h"
#include "Rays/March/RayTask.h"
#include "Rays/March/SampleApart.h"

#include <cstdint>
#include <limits>
#include <type_traits>

namespace schlieren
{

/// Relative, of a number.
template <class Number>
constexpr Number roundingOf = std::numeric_limits<Number>::epsilon();

/// Converts to an integer from 0 to `most`, which many numbers of steps exceed: they are estimates, of any size.
template <class Number>
SCHLIEREN_HD std::int32_t wholeSteps(Number steps, std::int32_t most)
{
  constexpr Number beyond = Number(2147483648.0); // the first that no std::int32_t holds
  if (!(steps > 0))
  {
    return 0;
  }
  return steps < beyond ? minimum(static_cast<std::int32_t>(steps), most) : most;
}

/// What the march of some rays may meet, as far as it is known when the code is compiled. On a GPU, each thing that
/// cannot be met saves registers.
template <bool image, bool tree, bool fields>
struct MayMeet
{
  static constexpr bool anImage = image;
  static constexpr bool aTree = tree;
  static constexpr bool fieldsToGather = fields;
};
using MayMeetAll = MayMeet<true, true, true>;

template <class Real>
struct LeavesOfPack; // for those who march with packs

/// What the march of some rays through the medium needs to know, and its steps.
template <class Kernel, class Real, class May = MayMeetAll>
struct March
{
  using Number = NumberOf<Real>;
  using Path = typename Kernel::Path;
  using Integrator = typename Kernel::Integrator;
  using Scheme = typename Kernel::Scheme;
  static constexpr int lanes = lanesOf<Real>;
  static constexpr bool isAdaptive = std::is_same_v<Integrator, Adaptive>;
  using Batch = RayBatch<Number, lanes>;

  const RayTask<Number>& task;
  Batch& batch;
  StraightLight<Real> light;
  Ray<Real> ray;
  using Leaves = std::conditional_t<lanes == 1, LeavesOfRays<Real>, LeavesOfPack<Real>>;
  Leaves in;                        ///< of a tree
  Vec3<Real> domainLow, domainHigh; ///< in local coordinates
  Real baseValue;                   ///< of the leaf: is added to what its samples say
  Real inGas;                       ///< 0 outside of it, else 1
  Real isConstant{};                ///< 1 in leaves where nothing changes, else 0
  bool someConstant = false;        ///< some rays are in a leaf where nothing changes
  bool someNearEdge = false;        ///< some rays are in a leaf where gas may end
  bool someNearEnd = true;          ///< some rays may leave the domain with their next step
  Vec3<Real> stepsToLast,
    stepsToFirst; ///< at least, per index coordinate towards the far or near side
  Real cruise;    ///< the usual step; 0 for rays that are not under way
  Real nextStep;  ///< Adaptive: no longer than this
  std::int32_t steps = 0;
  std::int32_t nextLook = 0; ///< at the homogeneity map
  bool areUnderWay = false;

  // Rays are distinguished by masks, or in arrays, but never by an index into a pack: that would keep the
  // pack in memory, in every step.

  SCHLIEREN_HD March(const RayTask<Number>& ofTask, Batch& ofBatch)
    : task(ofTask)
    , batch(ofBatch)
    , light{ packs(ofBatch.direction), packs(ofBatch.perLength), Vec3<Real>{} + ofTask.indexScale }
    , ray{}
    , domainLow{}
    , domainHigh(Vec3<Real>{} + static_cast<Vec3<Number>>(ofTask.medium.last))
    , baseValue{}
    , inGas(Real{} + 1)
    , stepsToLast(stepsPerIndex(light.perLength))
    , stepsToFirst(stepsPerIndex(Number(-1) * light.perLength))
    , nextStep(Real{} + ofTask.step)
  {
    Number usual[lanes], start[3][lanes];
    for (int i = 0; i < lanes; ++i)
    {
      usual[i] = batch.fate[i] == RayFate::Left ? task.step : 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        start[axis][i] = static_cast<Number>(batch.start[axis][i]);
      }
    }
    cruise = fromArray<Real>(usual);
    ray.start = packs(start);
    areUnderWay = any(cruise > 0);
    if (isTree())
    {
      enterTree();
    }
    park(cruise == 0);
    if constexpr (Path::bends)
    {
      ray.q = atEntry(valueApart(ray.start));
    }
  }

  /// q of light that enters a medium of nu, so that |p| = 1 + nu from the start: along d, or refracted by a face.
  SCHLIEREN_HD Vec3<Real> atEntry(const Real& nu) const
  {
    if (!task.light.faces.refract)
    {
      return nu * light.d;
    }
    const Vec3<Number> w = static_cast<Vec3<Number>>(task.light.w);
    const Real forward = w.x * light.d.x + w.y * light.d.y + w.z * light.d.z;
    // sqrt(forward^2 + more) - forward, in full relative precision. Less than 0 below the root: total reflection.
    const Real more = nu * (2 + nu);
    const Real entering = more / (forward + squareRoot(maximum(forward * forward + more, Real{})));
    const Real q = cruise > 0 ? entering : Real{}; // rays that are not under way have no direction
    return { q * w.x, q * w.y, q * w.z };
  }

  SCHLIEREN_HD bool isTree() const
  {
    return May::aTree && (!May::anImage || task.medium.leaves != nullptr);
  }
  SCHLIEREN_HD bool isGathering() const { return May::fieldsToGather && task.gradients.count > 0; }

  SCHLIEREN_HD static Vec3<Real> packs(const Number (&from)[3][lanes])
  {
    return { fromArray<Real>(from[0]), fromArray<Real>(from[1]), fromArray<Real>(from[2]) };
  }

  /// Puts rays where they disturb no others.
  template <class Mask>
  SCHLIEREN_HD void park(const Mask& which)
  {
    const Vec3<Number> middle = Number(0.5) * (task.medium.leafLow + task.medium.leafHigh);
    cruise = which ? Real{} : cruise;
    ray.start.x = which ? Real{} + middle.x : ray.start.x;
    ray.start.y = which ? Real{} + middle.y : ray.start.y;
    ray.start.z = which ? Real{} + middle.z : ray.start.z;
    ray.offset.x = which ? Real{} : ray.offset.x;
    ray.offset.y = which ? Real{} : ray.offset.y;
    ray.offset.z = which ? Real{} : ray.offset.z;
    ray.q.x = which ? Real{} : ray.q.x;
    ray.q.y = which ? Real{} : ray.q.y;
    ray.q.z = which ? Real{} : ray.q.z;
    ray.length = which ? Real{} : ray.length;
  }

  template <class Mask>
  SCHLIEREN_HD void finish(const Mask& which, RayFate fate, std::int32_t stepsTaken)
  {
    const auto put = [&which](const Real& from, Number(&to)[lanes])
    { toArray(which ? from : fromArray<Real>(to), to); };
    put(ray.offset.x, batch.offset[0]);
    put(ray.offset.y, batch.offset[1]);
    put(ray.offset.z, batch.offset[2]);
    const Vec3<Real> end = Path::position(ray, light);
    put(end.x, batch.end[0]);
    put(end.y, batch.end[1]);
    put(end.z, batch.end[2]);
    put(ray.q.x, batch.q[0]);
    put(ray.q.y, batch.q[1]);
    put(ray.q.z, batch.q[2]);
    put(ray.length, batch.length);
    put(ray.path, batch.path);
    put(ray.pathError, batch.pathError);
    Number isIt[lanes];
    toArray(which ? Real{} + 1 : Real{}, isIt);
    for (int i = 0; i < lanes; ++i)
    {
      if (isIt[i] != 0)
      {
        batch.fate[i] = fate;
        batch.steps[i] = stepsTaken;
        if (isTree())
        {
          in.toIndexCoordinates(task.medium, i, batch.offset);
          batch.length[i] += static_cast<Number>(in.travelled[i]);
        }
      }
    }
    park(which);
  }

  /// Calls visit(i, position, step) for the rays that are under way.
  template <class Visit>
  SCHLIEREN_HD void forRays(
    const Vec3<Real>& positions, const Real& lengths, const Visit& visit) const
  {
    Number x[lanes], y[lanes], z[lanes], step[lanes], isUnderWay[lanes];
    toArray(positions.x, x);
    toArray(positions.y, y);
    toArray(positions.z, z);
    toArray(lengths, step);
    toArray(cruise, isUnderWay);
    for (int i = 0; i < lanes; ++i)
    {
      if (isUnderWay[i] > 0)
      {
        visit(i, Vec3<Number>{ x[i], y[i], z[i] }, step[i]);
      }
    }
  }

  /// Up to the far side of the homogeneous cubes that the rays are in, where that is further. Returns
  /// whether there is any such cube.
  SCHLIEREN_HD bool lengthen(Real& step, const Vec3<Real>& x, const Vec3<Real>& along) const
  {
    Number low[3][lanes]{}, edge[lanes]{};
    forRays(clampTo(x, task.medium.leafHigh), step,
      [&](int i, const Vec3<Number>& at, Number)
      {
        const HomogeneousCube<Number> cube = homogeneousCube(task.map, at);
        low[0][i] = cube.low.x;
        low[1][i] = cube.low.y;
        low[2][i] = cube.low.z;
        edge[i] = cube.edge;
      });
    const Real edges = fromArray<Real>(edge);
    const auto isIn = edges > 0;
    if (!any(isIn))
    {
      return false;
    }
    const Vec3<Real> lows = { fromArray<Real>(low[0]), fromArray<Real>(low[1]),
      fromArray<Real>(low[2]) };
    const Real far = wayOut(x, along, lows, lows + Vec3<Real>{ edges, edges, edges });
    step = isIn ? maximum(step, far) : step;
    return true;
  }

  SCHLIEREN_HD StepsInLeaves<Number> stepsInLeaves() const
  {
    return { task.step, task.stepAtEdge };
  }

  /// Puts all rays into the leaves where they start.
  SCHLIEREN_HD void enterTree()
  {
    if constexpr (lanes == 1)
    {
      Number start[3][lanes];
      for (int i = 0; i < lanes; ++i)
      {
        in.enter(task.medium, i, batch.start);
        for (int axis = 0; axis < 3; ++axis)
        {
          start[axis][i] = static_cast<Number>(in.start[axis][i]);
        }
      }
      ray.start = packs(start);
    }
    else
    {
      enterLeaves(task.medium, stepsInLeaves(), batch.start, batch.perLength, in, ray.start);
    }
    takeLeaves();
  }

  SCHLIEREN_HD void takeLeaves()
  {
    LeavesInPacks<Real> leaves;
    readLeaves(task.medium, stepsInLeaves(), in, cruise, leaves);
    baseValue = leaves.value;
    domainLow = leaves.low;
    domainHigh = leaves.high;
    isConstant = leaves.isConstant;
    someConstant = leaves.someConstant;
    someNearEdge = leaves.someNearEdge;
    inGas = someNearEdge ? inGas : Real{} + 1;
    cruise = leaves.step;
    light.indexScale =
      scaled(Vec3<Real>{ leaves.perIndex, leaves.perIndex, leaves.perIndex }, task.indexScale);
    light.perLength = leaves.perIndex * packs(batch.perLength);
    if constexpr (lanes > 1)
    {
      // Leaves that are not at a side of the domain are as far from it as they are wide.
      const Number width = task.medium.leafHigh.x - task.medium.leafLow.x;
      const Real fewest = width * minimum(leastOf(stepsToLast), leastOf(stepsToFirst));
      someNearEnd = leaves.someNearEnd || any(fewest < 1);
    }
  }

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

  /// The medium at places of which some are in other leaves than the rays.
  SCHLIEREN_HD Sample<Real> sampleElsewhere(const Vec3<Real>& at) const
  {
    PlacesElsewhere<Real> places;
    findElsewhere(task.medium, in, at, places);
    return onlyGas(sampleAt<Scheme>(task, places));
  }

  /// Ends the rays that have come to a wall, and finds out which are where there is no gas.
  SCHLIEREN_HD void lookForEdges(Real& step, const Vec3<Real>& middle, const Vec3<Real>& half)
  {
    Real gas = inGas;
    const auto which = meetWalls(task.medium, in.leaf, middle, half, cruise, gas) > 0;
    inGas = gas;
    if (any(which))
    {
      finish(which, RayFate::Blocked, steps);
      step = which ? Real{} : step;
    }
  }

  SCHLIEREN_HD void stopInSolids(Real& step, const Vec3<Real>& middle)
  {
    Number blocked[lanes]{};
    forRays(middle, step,
      [&](int i, const Vec3<Number>& at, Number)
      { blocked[i] = isSolid(task.medium, at) ? 1 : 0; });
    const auto which = fromArray<Real>(blocked) > 0;
    if (any(which))
    {
      finish(which, RayFate::Blocked, steps);
      step = which ? Real{} : step;
    }
  }

  SCHLIEREN_HD void gather(const Vec3<Real>& middle, const Real& step) const
  {
    forRays(middle, step,
      [this](int i, const Vec3<Number>& at, Number length) {
        gatherGradients(task.gradients, isTree() ? in.leaf[i] : 0, at, length, batch.gathered[i]);
      });
  }

  SCHLIEREN_HD Sample<Real> sample(const Vec3<Real>& at) const
  {
    const std::int64_t* base = isTree() ? in.base : nullptr;
    Sample<Real> found;
    if constexpr (Integrator::samplesBeyond)
    {
      if (isTree() && any(insetOf(at, task.medium.leafLow, task.medium.leafHigh) < 0))
      {
        return sampleElsewhere(at);
      }
      found = sampleApart<Scheme>(task, base, withinLeaf(at));
    }
    else
    {
      found = interpolate<Scheme>(task.medium, base, withinLeaf(at));
    }
    found.value += baseValue;
    return onlyGas(found);
  }

  SCHLIEREN_NOINLINE Real valueApart(const Vec3<Real>& at) const { return sample(at).value; }

  SCHLIEREN_HD Sample<Real> onlyGas(const Sample<Real>& found) const
  {
    return someNearEdge ? Sample<Real>{ inGas * found.value, inGas * found.gradient } : found;
  }

  SCHLIEREN_HD Vec3<Real> withinLeaf(const Vec3<Real>& at) const
  {
    return clampTo(at, task.medium.leafLow, task.medium.leafHigh);
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

  template <class Mask>
  SCHLIEREN_HD void finishOutside(const Mask& leaving)
  {
    const auto done = areOutside(leaving);
    if (any(done))
    {
      finish(done, RayFate::Left, steps + 1);
    }
  }

  /// How far | |p| / n - 1 | is from 0, which nothing in the integration forces it to be.
  SCHLIEREN_HD Real drift(const Vec3<Real>& q, const Vec3<Real>& at) const
  {
    const Real nu = valueApart(at);
    const Real n = 1 + nu;
    const Real by = (2 * (dot(q, light.d) - nu) + dot(q, q) - nu * nu) / (2 * n * n);
    return by < 0 ? -by : by;
  }

  /// Finds the drift at the end.
  SCHLIEREN_HD void findDrift()
  {
    if constexpr (!Path::bends)
    {
      return;
    }
    toArray(drift(packs(batch.q), packs(batch.end)), batch.drift);
    for (int i = 0; i < lanes; ++i)
    {
      batch.drift[i] = batch.fate[i] == RayFate::Left ? batch.drift[i] : 0;
    }
  }

  /// The steps that a ray needs at least per local coordinate, which are the same in all leaves: dx/ds is off D
  /// by q.
  SCHLIEREN_HD Real stepsPerIndex(const Real& along, const Number& indexScale) const
  {
    constexpr Number slowest = Number(1e-9);
    return 1 / maximum(task.step * (along + task.largestQ * indexScale), Real{} + slowest);
  }
  SCHLIEREN_HD Vec3<Real> stepsPerIndex(const Vec3<Real>& along) const
  {
    return { stepsPerIndex(along.x, task.indexScale.x), stepsPerIndex(along.y, task.indexScale.y),
      stepsPerIndex(along.z, task.indexScale.z) };
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
    Number all = static_cast<Number>(left);
    for (const Number one : most)
    {
      all = one < all ? one : all;
    }
    return wholeSteps(all, left);
  }

  /// Whether rays meet nothing but the medium's samples.
  SCHLIEREN_HD bool isPlain() const
  {
    return !someConstant && !someNearEdge && task.map.levels == nullptr &&
      task.medium.solid == nullptr;
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
    constexpr int stepsBetweenLooks = 3;
    const Real usual = isTree() ? settle() : cruise;
    const Vec3<Real> x = Path::position(ray, light);
    const Vec3<Real> along = Path::along(ray, light);
    NextStep next{ isAdaptive ? minimum(usual, nextStep) : usual, x, usual < usual, false };
    Real& step = next.step;
    if (May::anImage && !isAdaptive && task.map.levels != nullptr && steps >= nextLook)
    {
      nextLook = steps + (lengthen(step, x, along) ? 1 : stepsBetweenLooks);
    }
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
    if (isGathering())
    {
      gather(withinLeaf(next.middle), someNearEdge ? inGas * next.step : next.step);
    }
    if (next.someLeave)
    {
      finishOutside(next.leaving);
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
