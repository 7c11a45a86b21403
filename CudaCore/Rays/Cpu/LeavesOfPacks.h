// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which leaves of a tree the rays of a pack are in: what LeafOfRay.h does for one ray. The rays are near each
// other, mostly in one leaf or two, so each leaf is looked for once, and all rays that are in it take what is known of
// it at the same time.
#pragma once

#include "Math/SimdPack.h"
#include "Rays/March/InBoxes.h"
#include "Rays/March/LeafOfRay.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace schlieren
{

/// See LeafOfRay. `first` is Leaf::first in units that are so small that it is a whole number, so that differences
/// of places in two leaves are exact without doubles.
template <class Real>
struct LeavesOfPack
{
  using Number = NumberOf<Real>;
  using Mask = decltype(Real{} < Real{});
  using Whole = std::conditional_t<sizeof(Number) == 4, std::int32_t, std::int64_t>;
  static constexpr int lanes = lanesOf<Real>;
  using View = MediumView<Number>;
  using Steps = StepsInLeaves<Number>;

  alignas(64) std::int64_t base[lanes]; ///< where each leaf's samples begin
  std::int32_t leaf[lanes];
  double entry[3][lanes];  ///< index coordinates where the ray enters the domain
  double travelled[lanes]; ///< from there to where the ray's length is 0
  double unit, perUnit;    ///< of `first`, in index coordinates
  Mask number;             ///< of the leaf
  Mask first[3];
  Real perIndex, voxel;  ///< local by index coordinates, and the reverse
  Real value, usualStep; ///< see LeavesInPacks
  Real isConstant, isNearEdge, isNearEnd;

  SCHLIEREN_HD void setUnit(const View& medium)
  {
    double most = 1;
    while (most < medium.last.x || most < medium.last.y || most < medium.last.z)
    {
      most *= 2;
    }
    constexpr double largest = 1 << 30;
    perUnit = largest / most;
    unit = 1 / perUnit;
  }

  /// A leaf that rays come to.
  struct There
  {
    std::int64_t base;
    std::int32_t number = -1;
    Whole first[3];
    Number perIndex, voxel, value, usualStep, isConstant, isNearEdge, isNearEnd;

    SCHLIEREN_HD void read(const View& medium, const Steps& steps, double perUnit, std::int32_t n)
    {
      const Leaf<Number>& leaf = medium.leaves[n];
      const double last[3] = { medium.last.x, medium.last.y, medium.last.z };
      number = n;
      base = leaf.brick * medium.brickStride;
      perIndex = static_cast<Number>(leaf.perIndex);
      voxel = 1 / perIndex;
      value = leaf.offset;
      usualStep = (leaf.kind == Leaf<Number>::Mixed ? steps.atEdge : steps.inGas) * voxel;
      isConstant = leaf.kind == Leaf<Number>::Constant ? Number(1) : Number(0);
      isNearEdge = leaf.kind == Leaf<Number>::Mixed || leaf.kind == Leaf<Number>::Solid ? Number(1)
                                                                                        : Number(0);
      bool isAtEnd = false;
      const double size = static_cast<double>(voxel);
      for (int axis = 0; axis < 3; ++axis)
      {
        first[axis] = static_cast<Whole>(leaf.first[axis] * perUnit);
        isAtEnd |= leaf.first[axis] < size || leaf.first[axis] + 16 * size > last[axis];
      }
      isNearEnd = isAtEnd ? Number(1) : Number(0);
    }
  };
  There latest; ///< that some rays have come to: others will follow

  /// Places in local coordinates of the rays' leaves, in those of another one.
  SCHLIEREN_HD Vec3<Real> toLocalOf(const There& there, const Vec3<Real>& at) const
  {
    const Real ratio = there.perIndex * voxel;
    const Number scale = there.perIndex * static_cast<Number>(unit);
    const auto shift = [&](int axis) __attribute__((always_inline))
    {
      return scale * __builtin_convertvector(first[axis] - there.first[axis], Real);
    };
    return { ratio * at.x + shift(0), ratio * at.y + shift(1), ratio * at.z + shift(2) };
  }

  /// Finds the leaves of places in local coordinates of the rays' leaves. Calls visit(leaf, mask of the places in
  /// it) for each. `likely`: one that some may be in; becomes the last one found.
  template <class Visit>
  SCHLIEREN_HD void find(const View& medium, const Steps& steps, const Vec3<Real>& at, Mask left,
    There& likely, const Visit& visit) const
  {
    if (likely.number >= 0)
    {
      const Mask isIn =
        left & (insetOf(toLocalOf(likely, at), medium.leafLow, medium.leafHigh) >= 0);
      visit(likely, isIn);
      left &= ~isIn;
    }
    unsigned bits = bitsOf(left);
    if (bits == 0)
    {
      return;
    }
    Whole corner[3][lanes];
    Number x[3][lanes], size[lanes], order[lanes];
    std::memcpy(corner, first, sizeof(corner));
    toArrays(at, x);
    toArray(voxel, size);
    for (int i = 0; i < lanes; ++i)
    {
      order[i] = static_cast<Number>(i);
    }
    const Real orders = fromArray<Real>(order);
    for (; bits != 0; bits = bitsOf(left))
    {
      const int i = __builtin_ctz(bits);
      double index[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        index[axis] = static_cast<double>(corner[axis][i]) * unit +
          static_cast<double>(x[axis][i]) * static_cast<double>(size[i]);
      }
      likely.read(medium, steps, perUnit, medium.finder.at({ index[0], index[1], index[2] }));
      const Real inset = insetOf(toLocalOf(likely, at), medium.leafLow, medium.leafHigh);
      // This one in any case: it may be on a side, or outside by rounding.
      const Mask isIn = left & ((inset >= 0) | (orders == static_cast<Number>(i)));
      visit(likely, isIn);
      left &= ~isIn;
    }
  }

  /// Puts rays into a leaf.
  SCHLIEREN_HD void put(const There& there, const Mask& which)
  {
    number = which ? Mask{} + there.number : number;
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = which ? Mask{} + there.first[axis] : first[axis];
    }
    perIndex = which ? Real{} + there.perIndex : perIndex;
    voxel = which ? Real{} + there.voxel : voxel;
    value = which ? Real{} + there.value : value;
    usualStep = which ? Real{} + there.usualStep : usualStep;
    isConstant = which ? Real{} + there.isConstant : isConstant;
    isNearEdge = which ? Real{} + there.isNearEdge : isNearEdge;
    isNearEnd = which ? Real{} + there.isNearEnd : isNearEnd;
    Whole isIt[lanes];
    std::memcpy(isIt, &which, sizeof(isIt));
    for (int i = 0; i < lanes; ++i)
    {
      base[i] = isIt[i] != 0 ? there.base : base[i];
      leaf[i] = isIt[i] != 0 ? there.number : leaf[i];
    }
  }

  /// Where the undisturbed rays are when their length is 0, in local coordinates.
  SCHLIEREN_HD Vec3<Real> starts(const Number (&perLength)[3][lanes]) const
  {
    Whole corner[3][lanes];
    Number scale[lanes], start[3][lanes];
    std::memcpy(corner, first, sizeof(corner));
    toArray(perIndex, scale);
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int i = 0; i < lanes; ++i)
      {
        const double index =
          entry[axis][i] + travelled[i] * static_cast<double>(perLength[axis][i]);
        start[axis][i] = static_cast<Number>(
          (index - static_cast<double>(corner[axis][i]) * unit) * static_cast<double>(scale[i]));
      }
    }
    return packsOf<Real>(start);
  }

  /// An offset in the leaf's local coordinates, in index coordinates.
  SCHLIEREN_HD void toIndexCoordinates(const View& medium, int i, Number (&offset)[3][lanes]) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      offset[axis][i] =
        static_cast<Number>(static_cast<double>(offset[axis][i]) / medium.leaves[leaf[i]].perIndex);
    }
  }
};

/// Puts all rays into the leaves where they enter the domain, at `index`.
template <class Real>
SCHLIEREN_NOINLINE void enterLeaves(const MediumView<NumberOf<Real>>& medium,
  const StepsInLeaves<NumberOf<Real>>& steps, const double (&index)[3][lanesOf<Real>],
  const NumberOf<Real> (&perLength)[3][lanesOf<Real>], LeavesOfPack<Real>& in, Vec3<Real>& start)
{
  using Leaves = LeavesOfPack<Real>;
  constexpr int lanes = lanesOf<Real>;
  in.setUnit(medium);
  for (int i = 0; i < lanes; ++i)
  {
    in.travelled[i] = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      in.entry[axis][i] = index[axis][i];
    }
  }
  // All into the leaf of the first, and from there to where they are.
  const typename Leaves::Mask all = Real{} == Real{};
  in.latest.read(
    medium, steps, in.perUnit, medium.finder.at({ index[0][0], index[1][0], index[2][0] }));
  in.put(in.latest, all);
  Leaves there = in;
  in.find(
    medium, steps, in.starts(perLength), all, there.latest,
    [&](const typename Leaves::There& one, const typename Leaves::Mask& which)
      __attribute__((always_inline)) { there.put(one, which); });
  in = there;
  start = in.starts(perLength);
}

/// See LeavesInPacks. `step`: 0 for rays that are not under way.
template <class Real>
SCHLIEREN_HD void readLeaves(const MediumView<NumberOf<Real>>& medium,
  const StepsInLeaves<NumberOf<Real>>&, const LeavesOfPack<Real>& in, const Real& step,
  LeavesInPacks<Real>& to)
{
  using Number = NumberOf<Real>;
  using Whole = typename LeavesOfPack<Real>::Whole;
  const Real scale = static_cast<Number>(in.unit) * in.perIndex;
  const auto local = [&](double index, int axis) __attribute__((always_inline))
  {
    return scale *
      __builtin_convertvector(static_cast<Whole>(index * in.perUnit) - in.first[axis], Real);
  };
  to.value = in.value;
  to.perIndex = in.perIndex;
  to.low = { local(0, 0), local(0, 1), local(0, 2) };
  to.high = { local(medium.last.x, 0), local(medium.last.y, 1), local(medium.last.z, 2) };
  to.step = step > 0 ? in.usualStep : Real{};
  to.isConstant = in.isConstant;
  to.someConstant = any((in.isConstant > 0) & (step > 0));
  to.someNearEdge = any((in.isNearEdge > 0) & (step > 0));
  to.someNearEnd = any((in.isNearEnd > 0) & (step > 0));
}

/// Moves the rays in question into the leaves of the middle of their next step; see LeafOfRay. Whether any
/// ray has changed its leaf.
template <class Real>
SCHLIEREN_NOINLINE bool changeLeaves(const MediumView<NumberOf<Real>>& medium,
  const StepsInLeaves<NumberOf<Real>>& steps, const NumberOf<Real> (&perLength)[3][lanesOf<Real>],
  LeavesOfPack<Real>& in, RaysBetweenLeaves<Real>& rays)
{
  using Leaves = LeavesOfPack<Real>;
  using Number = NumberOf<Real>;
  using Mask = typename Leaves::Mask;
  using There = typename Leaves::There;
  constexpr int lanes = lanesOf<Real>;
  const Mask isOut = rays.isOut > 0;
  Mask number = in.number;
  Real usual = rays.step;
  const auto take = [&](const There& there, const Mask& which) __attribute__((always_inline))
  {
    number = which ? Mask{} + there.number : number;
    usual = which ? Real{} + there.usualStep : usual;
  };
  in.find(medium, steps, rays.x + (Number(0.5) * rays.step) * rays.along, isOut, in.latest, take);
  // Where steps are shorter there, so is this one, which may then end before.
  const Mask isShorter = isOut & (usual < rays.step);
  if (any(isShorter))
  {
    rays.step = isShorter ? usual : rays.step;
    in.find(
      medium, steps, rays.x + (Number(0.5) * rays.step) * rays.along, isShorter, in.latest, take);
  }

  Mask left = number != in.number;
  if (!any(left))
  {
    return false;
  }
  Number lengthBefore[lanes];
  toArray(left ? rays.length : Real{}, lengthBefore);
  for (int i = 0; i < lanes; ++i)
  {
    in.travelled[i] += static_cast<double>(lengthBefore[i]);
  }
  const Mask which = left;
  const Real voxelBefore = in.voxel;
  typename Leaves::Whole numbers[lanes];
  std::memcpy(numbers, &number, sizeof(numbers));
  for (unsigned bits = bitsOf(left); bits != 0; bits = bitsOf(left))
  {
    const auto one = static_cast<std::int32_t>(numbers[__builtin_ctz(bits)]);
    const Mask isIt = left & (number == one);
    if (in.latest.number != one)
    {
      in.latest.read(medium, steps, in.perUnit, one);
    }
    in.put(in.latest, isIt);
    left &= ~isIt;
  }
  const Vec3<Real> start = in.starts(perLength);
  rays.start = either(which, start, rays.start);
  rays.length = which ? Real{} : rays.length;
  rays.finer = in.perIndex * voxelBefore;
  return true;
}

/// See PlacesElsewhere.
template <class Real>
SCHLIEREN_NOINLINE void findElsewhere(const MediumView<NumberOf<Real>>& medium,
  const LeavesOfPack<Real>& in, const Vec3<Real>& at, PlacesElsewhere<Real>& to)
{
  using Leaves = LeavesOfPack<Real>;
  using Mask = typename Leaves::Mask;
  using There = typename Leaves::There;
  // Within the domain.
  LeavesInPacks<Real> now;
  readLeaves(medium, {}, in, Real{}, now);
  const Vec3<Real> there = clampTo(at, now.low, now.high);
  to.at = there;
  to.value = Real{};
  to.finer = Real{};
  There latest;
  in.find(
    medium, { 1, 1 }, there, Real{} == Real{},
    latest, [&](const There& one, const Mask& which) __attribute__((always_inline)) {
      to.at = either(which, in.toLocalOf(one, there), to.at);
      to.value = which ? Real{} + one.value : to.value;
      to.finer = which ? one.perIndex * in.voxel : to.finer;
      typename Leaves::Whole isIt[lanesOf<Real>];
      std::memcpy(isIt, &which, sizeof(isIt));
      for (int i = 0; i < lanesOf<Real>; ++i)
      {
        to.base[i] = isIt[i] != 0 ? one.base : to.base[i];
      }
    });
}

} // namespace schlieren
