// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two packs of rays in turn: while one waits for what it has read, the other is computed. Where there is nothing in
// their way but the medium's samples, their steps are loops of their own, whose rays are copies: the compiler keeps
// these in registers.
#pragma once

#include "Medium/SimdInterpolation.h"
#include "Rays/BlockOfLeaves.h"
#include "Rays/Marcher.h"

namespace schlieren
{

/// At most `most` steps of which none leaves the grid.
template <class Kernel, class Real>
SCHLIEREN_HD void takeStepsInside(March<Kernel, Real>& a, March<Kernel, Real>& b, std::int32_t most)
{
  using Number = NumberOf<Real>;
  using Path = typename Kernel::Path;
  Ray<Real> ofA = a.ray, ofB = b.ray;
  for (std::int32_t taken = 0; taken < most; ++taken)
  {
    a.advance(ofA, a.cruise, Path::ahead(ofA, a.light, Number(0.5) * a.cruise));
    b.advance(ofB, b.cruise, Path::ahead(ofB, b.light, Number(0.5) * b.cruise));
  }
  a.ray = ofA;
  b.ray = ofB;
  a.steps += most;
  b.steps += most;
}

/// What a pack finds where it looks in a block.
template <class Kernel, class Real>
struct SamplerInBlock
{
  const MediumView<NumberOf<Real>>& medium;
  const typename BlockOfLeaves<Real>::Place& place;

  SCHLIEREN_HD Sample<Real> operator()(const Vec3<Real>&) const
  {
    Sample<Real> found = interpolate<typename Kernel::Scheme>(medium, place.base, place.local);
    found.value += place.value;
    return found;
  }
};

/// A pack in a block of leaves.
template <class Kernel, class Real>
struct MarchInBlock
{
  using Number = NumberOf<Real>;
  using Path = typename Kernel::Path;
  using Marching = March<Kernel, Real>;
  using Place = typename BlockOfLeaves<Real>::Place;

  Marching& march;
  BlockOfLeaves<Real> block;
  Number reach;

  SCHLIEREN_HD explicit MarchInBlock(Marching& of)
    : march(of)
  {
    Number least[lanesOf<Real>];
    toArray(minimum(leastOf(of.stepsToLast), leastOf(of.stepsToFirst)), least);
    reach = 1 / least[0];
    for (const Number one : least)
    {
      reach = maximum(reach, 1 / one);
    }
  }

  SCHLIEREN_HD bool isUnknown(const Place& place) const
  {
    return any(place.isUnknown & (march.cruise > 0));
  }

  SCHLIEREN_HD Vec3<Real> middle(const Ray<Real>& ray) const
  {
    return Path::ahead(ray, march.light, Number(0.5) * march.cruise);
  }

  SCHLIEREN_HD void find(const Ray<Real>& ray, Place& place) const
  {
    block.find(march.task.medium, middle(ray), place);
  }

  SCHLIEREN_HD bool mayLeave(const Ray<Real>& ray) const
  {
    return march.someNearEnd &&
      any((insetOf(Path::ahead(ray, march.light, march.cruise), march.domainLow, march.domainHigh) <
            0) &
        (march.cruise > 0));
  }

  SCHLIEREN_HD void take(const Ray<Real>& ray, const Place& place, Ray<Real>& next) const
  {
    next = ray;
    Kernel::Integrator::template advance<Path>(next, march.light, march.cruise, place.local,
      SamplerInBlock<Kernel, Real>{ march.task.medium, place });
  }

  /// Sees to it that the pack is in a block with all leaves that it looks at. Returns whether it is.
  SCHLIEREN_NOINLINE bool enter(Ray<Real>& ray)
  {
    RaysInBlock<Real> rays{ middle(ray), Path::along(ray, march.light), march.cruise, ray.start,
      ray.length, {}, {}, false, {} };
    const bool isIn =
      takeBlock(march.task.medium, march.batch.perLength, reach, march.in, block, rays);
    ray.start = rays.start;
    ray.length = rays.length;
    march.domainLow = rays.low;
    march.domainHigh = rays.high;
    march.someNearEnd = rays.someNearEnd;
    return isIn;
  }

  SCHLIEREN_NOINLINE void leave(const Ray<Real>& ray)
  {
    march.ray = ray;
    RaysInBlock<Real> rays{ Path::position(ray, march.light), {}, march.cruise, ray.start,
      ray.length, {}, {}, false, {} };
    leaveBlock(march.task.medium, march.stepsInLeaves(), march.batch.perLength, march.in, rays);
    march.ray.start = rays.start;
    march.ray.length = rays.length;
    march.ray.offset = rays.finer * march.ray.offset;
    march.takeLeaves();
  }
};

/// Steps through leaves of a tree that nothing but samples are in and that have one size.
template <class Kernel, class Real>
SCHLIEREN_HD void takeStepsInBlocks(March<Kernel, Real>& a, March<Kernel, Real>& b)
{
  MarchInBlock<Kernel, Real> inA(a), inB(b);
  Ray<Real> ofA = a.ray, ofB = b.ray;
  const std::int32_t most = a.task.stepLimit - maximum(a.steps, b.steps);
  std::int32_t taken = 0;
  if (inA.enter(ofA) & inB.enter(ofB))
  {
    for (; taken < most; ++taken)
    {
      typename BlockOfLeaves<Real>::Place atA, atB;
      inA.find(ofA, atA);
      inB.find(ofB, atB);
      if (inA.isUnknown(atA) || inB.isUnknown(atB))
      {
        if ((inA.isUnknown(atA) && !inA.enter(ofA)) || (inB.isUnknown(atB) && !inB.enter(ofB)))
        {
          break;
        }
        inA.find(ofA, atA);
        inB.find(ofB, atB);
      }
      if (inA.mayLeave(ofA) || inB.mayLeave(ofB))
      {
        break;
      }
      inA.take(ofA, atA, ofA);
      inB.take(ofB, atB, ofB);
    }
  }
  inA.leave(ofA);
  inB.leave(ofB);
  a.steps += taken;
  b.steps += taken;
}

/// Takes the rays of two batches through the medium.
template <class Kernel, class Real>
SCHLIEREN_HD void marchTwo(const RayTask<NumberOf<Real>>& task,
  RayBatch<NumberOf<Real>, lanesOf<Real>>& one, RayBatch<NumberOf<Real>, lanesOf<Real>>& other)
{
  March<Kernel, Real> a(task, one);
  March<Kernel, Real> b(task, other);
  constexpr std::int32_t worthIt = 4;
  const bool isTree = a.isTree();
  const bool mayBePlain = !a.isGathering();
  // What blocks are for, long rows of leaves, are not what leaves of one layer are crossed in.
  const bool hasBlocks = isTree && task.medium.planeStride != 0;
  // To look again: a tree's leaves are left often.
  const std::int32_t pause = isTree ? 2 : 8;
  std::int32_t next = 0;
  while (a.areUnderWay && b.areUnderWay)
  {
    if (mayBePlain && a.steps >= next && a.isPlain() && b.isPlain())
    {
      const std::int32_t before = a.steps;
      if (hasBlocks)
      {
        takeStepsInBlocks(a, b);
      }
      else if (const std::int32_t inside = minimum(a.stepsInside(), b.stepsInside());
               inside >= worthIt)
      {
        takeStepsInside(a, b, inside);
      }
      next = a.steps - before < worthIt ? a.steps + pause : 0;
    }
    a.takeStep();
    b.takeStep();
  }
  while (a.areUnderWay)
  {
    a.takeStep();
  }
  while (b.areUnderWay)
  {
    b.takeStep();
  }
  a.findDrift();
  b.findDrift();
}

} // namespace schlieren
