// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Samples/Interpolation.h"
#include "Rays/March/InBoxes.h"

#include <cstdint>

namespace schlieren
{

/// How long steps are, in units of the light's unit of length.
template <class Number>
struct StepsInLeaves
{
  Number inGas;  ///< where voxels are as large as the index coordinates' unit
  Number atEdge; ///< the same where gas may end

  SCHLIEREN_HD Number in(const Leaf<Number>& leaf) const
  {
    return (leaf.kind == Leaf<Number>::Mixed ? atEdge : inGas) / static_cast<Number>(leaf.perIndex);
  }
};

/// What is known of the leaves of a pack's rays.
template <class Real>
struct LeavesInPacks
{
  Vec3<Real> low, high; ///< the domain's corners, local coordinates
  Real value;           ///< is to be added to what samples say
  Real perIndex;        ///< local by index coordinates
  Real step;            ///< the usual one; 0 for rays that are not under way
  Real isConstant;      ///< 1 where nothing changes, else 0
  bool someConstant;    ///< of the rays that are under way
  bool someNearEdge;    ///< likewise: gas may end
  bool someNearEnd;     ///< likewise: the leaf is at a side of the domain
};

/// A pack of rays that is to change leaves.
template <class Real>
struct RaysBetweenLeaves
{
  Real isOut; ///< 1 for the rays in question, 0 for others
  Vec3<Real> x, along;
  Real step; ///< becomes as long as it may be
  // Of rays that do change:
  Vec3<Real> start; ///< where the length is 0
  Real length;      ///< becomes 0
  Real finer;       ///< the new local coordinates by the old ones; 1 for others
};

/// Where a pack of places lies that may be in other leaves than the rays.
template <class Real>
struct PlacesElsewhere
{
  alignas(64) std::int64_t base[lanesOf<Real>];
  Vec3<Real> at; ///< local coordinates of the leaf that each is in
  Real value;    ///< see LeavesInPacks
  Real finer;    ///< these local coordinates by those of the rays' leaves
};

/// Which leaf of a tree a ray is in. The undisturbed ray is followed in doubles from leaf to leaf, so
/// that nothing is lost however many there are. Arrays as LeavesOfPack has them.
template <class Number>
struct LeafOfRay
{
  std::int64_t base[1]; ///< where the leaf's samples begin
  std::int32_t leaf[1];
  double travelled[1]; ///< up to the start, since the ray entered the domain
  Vec3<double> start;  ///< local coordinates where the ray's length is 0

  SCHLIEREN_HD const Leaf<Number>& in(const MediumView<Number>& medium) const
  {
    return medium.leaves[leaf[0]];
  }
  SCHLIEREN_HD void put(const MediumView<Number>& medium, std::int32_t number)
  {
    leaf[0] = number;
    base[0] = medium.leaves[number].brick * medium.brickStride;
  }

  /// An offset in the leaf's local coordinates, in index coordinates.
  SCHLIEREN_HD void toIndexCoordinates(
    const MediumView<Number>& medium, int, Number (&offset)[3][1]) const
  {
    for (Number(&along)[1] : offset)
    {
      along[0] = static_cast<Number>(static_cast<double>(along[0]) / in(medium).perIndex);
    }
  }
};

// The functions from here on are no members of what holds the ray: it would be kept in memory, in every step.

/// Puts the ray into the leaf where it enters the domain, at `index`.
template <class Number>
SCHLIEREN_HD void enterLeaves(const MediumView<Number>& medium, const StepsInLeaves<Number>&,
  const double (&index)[3][1], const Number (&)[3][1], LeafOfRay<Number>& ray, Vec3<Number>& start)
{
  const Vec3<double> at = packsOf<double>(index);
  ray.put(medium, medium.finder.at(at));
  ray.travelled[0] = 0;
  ray.start = ray.in(medium).toLocal(at);
  start = static_cast<Vec3<Number>>(ray.start);
}

/// See LeavesInPacks. `step`: the steps so far, 0 for a ray that is not under way.
template <class Number>
SCHLIEREN_NOINLINE void readLeaves(const MediumView<Number>& medium,
  const StepsInLeaves<Number>& steps, const LeafOfRay<Number>& ray, const Number& step,
  LeavesInPacks<Number>& to)
{
  const Leaf<Number>& leaf = ray.in(medium);
  const bool isConstant = leaf.kind == Leaf<Number>::Constant;
  to.low = static_cast<Vec3<Number>>(leaf.toLocal({ 0, 0, 0 }));
  to.high = static_cast<Vec3<Number>>(leaf.toLocal(medium.last));
  to.value = leaf.offset;
  to.perIndex = static_cast<Number>(leaf.perIndex);
  to.step = step > 0 ? steps.in(leaf) : step;
  to.isConstant = isConstant ? Number(1) : Number(0);
  to.someConstant = step > 0 && isConstant;
  to.someNearEdge =
    step > 0 && (leaf.kind == Leaf<Number>::Mixed || leaf.kind == Leaf<Number>::Solid);
  to.someNearEnd = true;
}

/// Moves the ray into the leaf of the middle of its next step. Where steps are shorter there, so is this one. Whether it
/// has changed its leaf.
template <class Number>
SCHLIEREN_NOINLINE bool changeLeaves(const MediumView<Number>& medium,
  const StepsInLeaves<Number>& steps, const Number (&perLength)[3][1], LeafOfRay<Number>& ray,
  RaysBetweenLeaves<Number>& there)
{
  const Leaf<Number>& now = ray.in(medium);
  const auto leafOfMiddle = [&]
  {
    return medium.finder.at(now.toIndex(static_cast<Vec3<double>>(there.x) +
      (0.5 * static_cast<double>(there.step)) * static_cast<Vec3<double>>(there.along)));
  };
  std::int32_t to = leafOfMiddle();
  const Number usual = steps.in(medium.leaves[to]);
  if (usual < there.step)
  {
    there.step = usual;
    to = leafOfMiddle();
  }
  if (to == ray.leaf[0])
  {
    return false;
  }
  const Leaf<Number>& then = medium.leaves[to];
  const auto length = static_cast<double>(there.length);
  const auto along = static_cast<Vec3<double>>(packsOf<Number>(perLength));
  ray.start = then.toLocal(now.toIndex(ray.start + now.perIndex * (length * along)));
  ray.travelled[0] += length;
  ray.put(medium, to);
  there.finer = static_cast<Number>(then.perIndex / now.perIndex);
  there.length = 0;
  there.start = static_cast<Vec3<Number>>(ray.start);
  return true;
}

/// See PlacesElsewhere.
template <class Number>
SCHLIEREN_NOINLINE void findElsewhere(const MediumView<Number>& medium,
  const LeafOfRay<Number>& ray, const Vec3<Number>& at, PlacesElsewhere<Number>& to)
{
  const Leaf<Number>& now = ray.in(medium);
  const Vec3<double> index = clampTo(now.toIndex(static_cast<Vec3<double>>(at)), medium.last);
  const Leaf<Number>& found = medium.leaves[medium.finder.at(index)];
  to.base[0] = found.brick * medium.brickStride;
  to.at = static_cast<Vec3<Number>>(found.toLocal(index));
  to.value = found.offset;
  to.finer = static_cast<Number>(found.perIndex / now.perIndex);
}

} // namespace schlieren
