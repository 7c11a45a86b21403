// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays on their way: one where Real is a number (CUDA, and the CPU where there is nothing better), several side by
// side where it is a pack.
#pragma once

#include "Rays/March/LeafOfRay.h"
#include "Rays/March/RayTask.h"
#include "Rays/March/SampleApart.h"

#include <cstdint>
#include <type_traits>

namespace schlieren
{

/// What the march of some rays may meet, as far as it is known when the code is compiled. On a GPU, each thing that
/// cannot be met saves registers.
template <bool image, bool tree>
struct MayMeet
{
  static constexpr bool anImage = image;
  static constexpr bool aTree = tree;
};
using MayMeetAll = MayMeet<true, true>;

template <class Real>
struct LeavesOfPack; // for those who march with packs

/// Some rays of a task: where they are, what they see of the medium there, how they begin and end.
template <class Kernel, class Real, class May>
struct RaysInMedium
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
  using Leaves = std::conditional_t<lanes == 1, LeafOfRay<Real>, LeavesOfPack<Real>>;
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
  bool areUnderWay = false;

  // Rays are distinguished by masks, or in arrays, but never by an index into a pack: that would keep the
  // pack in memory, in every step.

  SCHLIEREN_HD RaysInMedium(const RayTask<Number>& ofTask, Batch& ofBatch)
    : task(ofTask)
    , batch(ofBatch)
    , light{ packsOf<Real>(ofBatch.direction), packsOf<Real>(ofBatch.perLength),
      Vec3<Real>{} + ofTask.indexScale }
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
    ray.start = packsOf<Real>(start);
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

  /// Puts rays where they disturb no others.
  template <class Mask>
  SCHLIEREN_HD void park(const Mask& which)
  {
    const Vec3<Number> middle = Number(0.5) * (task.medium.leafLow + task.medium.leafHigh);
    cruise = which ? Real{} : cruise;
    ray.start = either(which, Vec3<Real>{} + middle, ray.start);
    ray.offset = either(which, Vec3<Real>{}, ray.offset);
    ray.q = either(which, Vec3<Real>{}, ray.q);
    ray.length = which ? Real{} : ray.length;
  }

  template <class Mask>
  SCHLIEREN_HD void finish(const Mask& which, RayFate fate, std::int32_t stepsTaken)
  {
    const auto put = [&which](const Real& from, Number(&to)[lanes])
    { toArray(which ? from : fromArray<Real>(to), to); };
    const auto putAll = [&put](const Vec3<Real>& from, Number(&to)[3][lanes])
    {
      put(from.x, to[0]);
      put(from.y, to[1]);
      put(from.z, to[2]);
    };
    putAll(ray.offset, batch.offset);
    putAll(Path::position(ray, light), batch.end);
    putAll(ray.q, batch.q);
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
    Number x[3][lanes], step[lanes], isUnderWay[lanes];
    toArrays(positions, x);
    toArray(lengths, step);
    toArray(cruise, isUnderWay);
    for (int i = 0; i < lanes; ++i)
    {
      if (isUnderWay[i] > 0)
      {
        visit(i, Vec3<Number>{ x[0][i], x[1][i], x[2][i] }, step[i]);
      }
    }
  }

  SCHLIEREN_HD StepsInLeaves<Number> stepsInLeaves() const
  {
    return { task.step, task.stepAtEdge };
  }

  /// Puts all rays into the leaves where they start.
  SCHLIEREN_HD void enterTree()
  {
    enterLeaves(task.medium, stepsInLeaves(), batch.start, batch.perLength, in, ray.start);
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
    light.perLength = leaves.perIndex * packsOf<Real>(batch.perLength);
    if constexpr (lanes > 1)
    {
      // Leaves that are not at a side of the domain are as far from it as they are wide.
      const Number width = task.medium.leafHigh.x - task.medium.leafLow.x;
      const Real fewest = width * minimum(leastOf(stepsToLast), leastOf(stepsToFirst));
      someNearEnd = leaves.someNearEnd || any(fewest < 1);
    }
  }

  /// The medium at places of which some are in other leaves than the rays.
  SCHLIEREN_HD Sample<Real> sampleElsewhere(const Vec3<Real>& at) const
  {
    PlacesElsewhere<Real> places;
    findElsewhere(task.medium, in, at, places);
    return onlyGas(sampleAt<Scheme>(task, places));
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

  /// How far | |p| / n - 1 | is from 0, which nothing in the integration forces it to be.
  SCHLIEREN_HD Real drift(const Vec3<Real>& q, const Vec3<Real>& at) const
  {
    const Real nu = valueApart(at);
    const Real n = 1 + nu;
    const Real by = (2 * (dot(q, light.d) - nu) + dot(q, q) - nu * nu) / (2 * n * n);
    return by < 0 ? -by : by;
  }

  SCHLIEREN_HD void findDrift()
  {
    if constexpr (!Path::bends)
    {
      return;
    }
    toArray(drift(packsOf<Real>(batch.q), packsOf<Real>(batch.end)), batch.drift);
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
};

} // namespace schlieren
