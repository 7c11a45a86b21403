// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two packs of rays in turn: while one waits for what it has read, the other is computed. Where there is nothing in
// their way but the medium's samples, their steps are loops of their own, whose rays are copies: the compiler keeps
// these in registers.
#pragma once

#include "Medium/Samples/SimdInterpolation.h"
#include "Rays/Cpu/BlockOfLeaves.h"
#include "Rays/Cpu/SimdMarch.h"
#include "Rays/March/Marcher.h"

namespace schlieren
{

/// SchemeOfTask, by rows.
struct SchemeOfTaskByRows : SchemeOfTask
{
  template <class Scheme>
  using Of = ByRows<Scheme>;
};

/// Takes `most` steps, of which none leaves the grid.
template <class Kernel, class Real, class May>
SCHLIEREN_HD void takeStepsInside(
  March<Kernel, Real, May>& a, March<Kernel, Real, May>& b, std::int32_t most)
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

  using Int = IntOf<Real>;

  Marching& march;
  BlockOfLeaves<Real> block;
  Number reach;
  /// Where the leaves of the middles of the last steps begin: these the rays are in, see March::settle.
  typename LeavesOfPack<Real>::Mask last[3];

  SCHLIEREN_HD explicit MarchInBlock(Marching& of)
    : march(of)
    , last{ of.in.first[0], of.in.first[1], of.in.first[2] }
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
    RaysInBlock<Real> rays{ {}, {}, march.cruise, ray.start, ray.length, {}, {}, false, {} };
    leaveBlock(
      march.task.medium, march.stepsInLeaves(), march.batch.perLength, last, march.in, rays);
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
  using Block = MarchInBlock<Kernel, Real>;
  Block inA(a), inB(b);
  Ray<Real> ofA = a.ray, ofB = b.ray;
  const std::int32_t most = a.task.stepLimit - maximum(a.steps, b.steps);
  std::int32_t taken = 0;
  typename Block::Int lastOfA{},
    lastOfB{}; // leaves of the blocks, where steps have been taken in these
  bool hasLastOfA = false, hasLastOfB = false;
  const auto keepLast =
    [](Block & in, const typename Block::Int& leaf, bool& hasLeaf) __attribute__((always_inline))
  {
    if (hasLeaf)
    {
      in.block.findFirst(leaf, in.last);
      hasLeaf = false;
    }
  };
  if (inA.enter(ofA) & inB.enter(ofB))
  {
    for (; taken < most; ++taken)
    {
      typename BlockOfLeaves<Real>::Place atA, atB;
      inA.find(ofA, atA);
      inB.find(ofB, atB);
      if (inA.isUnknown(atA) || inB.isUnknown(atB))
      {
        keepLast(inA, lastOfA, hasLastOfA);
        keepLast(inB, lastOfB, hasLastOfB);
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
      lastOfA = atA.leaf;
      lastOfB = atB.leaf;
      hasLastOfA = hasLastOfB = true;
    }
  }
  keepLast(inA, lastOfA, hasLastOfA);
  keepLast(inB, lastOfB, hasLastOfB);
  inA.leave(ofA);
  inB.leave(ofB);
  a.steps += taken;
  b.steps += taken;
}

/// Fewer steps are not worth a loop of their own.
constexpr std::int32_t worthALoop = 4;

/// Some steps of packs that isPlain(), where there are enough of them.
template <class Kernel, class Real, class May>
SCHLIEREN_HD void takePlainSteps(March<Kernel, Real, May>& a, March<Kernel, Real, May>& b)
{
  // What blocks are for, long rows of leaves, are not what leaves of one layer are crossed in.
  if (a.isTree() && a.task.medium.planeStride != 0)
  {
    takeStepsInBlocks(a, b);
    return;
  }
  const std::int32_t inside = minimum(a.stepsInside(), b.stepsInside());
  if (inside >= worthALoop)
  {
    takeStepsInside(a, b, inside);
  }
}

/// Takes the rays of two packs through the medium.
template <class Kernel, class Real, class May>
SCHLIEREN_HD void marchTwo(March<Kernel, Real, May>& a, March<Kernel, Real, May>& b)
{
  const bool mayBePlain = !a.isGathering();
  // To look again: a tree's leaves are left often.
  const std::int32_t pause = a.isTree() ? 2 : 8;
  std::int32_t next = 0;
  while (a.areUnderWay && b.areUnderWay)
  {
    if (mayBePlain && a.steps >= next && a.isPlain() && b.isPlain())
    {
      const std::int32_t before = a.steps;
      takePlainSteps(a, b);
      next = a.steps - before < worthALoop ? a.steps + pause : 0;
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
