// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/Cpu/LeavesOfPacks.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace schlieren
{

/// Eight leaves of one size, two along each axis, that nothing but samples are in. As long as the rays of a pack stay in
/// such a block, they go from leaf to leaf without anything to be done: all have the local coordinates of its first
/// leaf, in which the second ones begin at 15.5.
template <class Real>
struct BlockOfLeaves
{
  using Number = NumberOf<Real>;
  using Int = IntOf<Real>;
  using Whole = typename LeavesOfPack<Real>::Whole;
  static constexpr int lanes = lanesOf<Real>;
  static constexpr int logEdge = 4;
  static constexpr int edge = 1 << logEdge; ///< of a leaf, in voxels

  Number value[8];           ///< of each leaf; NaN: not looked for, or not of this size and kind
  std::int32_t brick[8];     ///< likewise; 0
  Whole at[3] = { 0, 0, 0 }; ///< of the first leaf: its place, in units of its size
  Whole size = 0; ///< of a leaf, in those of LeavesOfPack::first; 0: there is no block yet

  SCHLIEREN_HD void clear()
  {
    for (int i = 0; i < 8; ++i)
    {
      value[i] = std::numeric_limits<Number>::quiet_NaN();
      brick[i] = 0;
    }
  }

  /// Where a pack looks.
  struct Place
  {
    Vec3<Real> local; ///< in the leaf
    Real value;
    alignas(64) std::int64_t base[lanes];
    decltype(Real{} < Real{}) isUnknown;
    Int leaf; ///< of the eight
  };

  /// Where leaves of the eight begin, in units of LeavesOfPack.
  template <class Mask>
  SCHLIEREN_HD void findFirst(const Int& leaf, Mask (&first)[3]) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Mask upper = __builtin_convertvector(leaf >> axis & 1, Mask);
      first[axis] = (upper + at[axis]) * size + size / (2 * edge);
    }
  }

  /// Begins at other leaves, counted in leaves of `newSize`, and keeps what is known of those that it already had.
  SCHLIEREN_HD void beginAt(Whole newSize, const Whole (&begins)[3])
  {
    const BlockOfLeaves before = *this;
    clear();
    size = newSize;
    for (int axis = 0; axis < 3; ++axis)
    {
      at[axis] = begins[axis];
    }
    for (int i = 0; before.size == size && i < 8; ++i)
    {
      const Whole old[3] = { begins[0] + (i & 1) - before.at[0],
        begins[1] + (i >> 1 & 1) - before.at[1], begins[2] + (i >> 2) - before.at[2] };
      if ((old[0] & ~Whole(1)) == 0 && (old[1] & ~Whole(1)) == 0 && (old[2] & ~Whole(1)) == 0)
      {
        const auto number = (old[2] * 2 + old[1]) * 2 + old[0];
        value[i] = before.value[number];
        brick[i] = before.brick[number];
      }
    }
  }

  /// `x`: in local coordinates of the first leaf.
  SCHLIEREN_HD void find(const MediumView<Number>& medium, const Vec3<Real>& x, Place& place) const
  {
    constexpr auto half = Number(0.5);
    const Vec3<Real> up = { x.x + half, x.y + half, x.z + half };
    const Int cell[3] = { __builtin_convertvector(up.x, Int) >> logEdge,
      __builtin_convertvector(up.y, Int) >> logEdge,
      __builtin_convertvector(up.z, Int) >> logEdge };
    constexpr Number upTo = 2 * edge;
    const Real least = leastOf(up);
    const Real most = maximum(up.x, maximum(up.y, up.z));
    place.leaf = ((cell[2] & 1) * 2 + (cell[1] & 1)) * 2 + (cell[0] & 1);
    place.value = lookUp<Real>(value, place.leaf);
    place.isUnknown = !((least >= 0) & (most < upTo) & (place.value == place.value));
    place.value = place.isUnknown ? Real{} : place.value;
    const auto local = [&](const Real& of, const Int& in) __attribute__((always_inline))
    {
      return of - Number(edge) * __builtin_convertvector(in, Real);
    };
    place.local = { local(x.x, cell[0]), local(x.y, cell[1]), local(x.z, cell[2]) };
    std::uint32_t bricks[lanes];
    const Int ofRays = lookUp<Int>(brick, place.leaf);
    std::memcpy(bricks, &ofRays, sizeof(bricks));
    const auto stride = static_cast<std::uint32_t>(medium.brickStride);
    for (int i = 0; i < lanes; ++i)
    {
      place.base[i] = static_cast<std::int64_t>(std::uint64_t{ bricks[i] } * stride);
    }
  }
};

/// A pack that continues in a block.
template <class Real>
struct RaysInBlock
{
  Vec3<Real> x; ///< where they look, in local coordinates of their leaves
  Vec3<Real> along;
  Real isUnderWay; ///< > 0
  Vec3<Real> start;
  Real length;
  Vec3<Real> low, high; ///< the domain's corners
  bool someNearEnd;
  Real finer; ///< the new local coordinates by the old ones
};

/// Finds where a block begins that has the leaves which rays look at, counted in leaves. Returns false where rays are too far
/// from each other for one block. `one`: one of the rays that go.
template <class Real>
SCHLIEREN_HD bool findCorner(const LeavesOfPack<Real>& in, const RaysInBlock<Real>& rays,
  const typename LeavesOfPack<Real>::Mask& goes, int one, int logSize,
  typename LeavesOfPack<Real>::Whole (&begins)[3])
{
  using Number = NumberOf<Real>;
  using Mask = typename LeavesOfPack<Real>::Mask;
  using Whole = typename LeavesOfPack<Real>::Whole;
  constexpr int lanes = lanesOf<Real>;
  Number along[3][lanes];
  toArrays(rays.along, along);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Real& x = axis == 0 ? rays.x.x : axis == 1 ? rays.x.y : rays.x.z;
    constexpr Number far = 4;
    const Real within = (x + Number(0.5)) * (Number(1) / BlockOfLeaves<Real>::edge);
    const Mask cells = (in.first[axis] >> logSize) +
      (__builtin_convertvector(within + far, Mask) - static_cast<Whole>(far));
    Whole all[lanes];
    std::memcpy(all, &cells, sizeof(all));
    const Mask from = cells - all[one];
    const bool someBelow = any(goes & (from < 0));
    if (any(goes & ((from < -1) | (from > 1) | (within < -far) | (within > far))) ||
      (someBelow && any(goes & (from > 0))))
    {
      return false;
    }
    const bool isUpper = !any(goes & (from != 0)) && along[axis][one] < 0;
    begins[axis] = all[one] - (someBelow || isUpper ? 1 : 0);
  }
  return true;
}

/// Moves the rays that go into a block, and returns where they look, in its local coordinates.
template <class Real>
SCHLIEREN_HD Vec3<Real> moveInto(const typename LeavesOfPack<Real>::There& there,
  const NumberOf<Real> (&perLength)[3][lanesOf<Real>],
  const typename LeavesOfPack<Real>::Mask& goes, LeavesOfPack<Real>& in, RaysInBlock<Real>& rays)
{
  using Mask = typename LeavesOfPack<Real>::Mask;
  constexpr int lanes = lanesOf<Real>;
  const Vec3<Real> places = in.toLocalOf(there, rays.x);
  NumberOf<Real> lengths[lanes];
  toArray(goes ? rays.length : Real{}, lengths);
  for (int i = 0; i < lanes; ++i)
  {
    in.travelled[i] += static_cast<double>(lengths[i]);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    in.first[axis] = goes ? Mask{} + there.first[axis] : in.first[axis];
  }
  in.number = goes ? Mask{} - 1 : in.number; // none
  const Vec3<Real> start = in.starts(perLength);
  rays.start.x = goes ? start.x : rays.start.x;
  rays.start.y = goes ? start.y : rays.start.y;
  rays.start.z = goes ? start.z : rays.start.z;
  rays.length = goes ? Real{} : rays.length;
  return places;
}

/// Reads the leaves that rays look at and that a block does not know. Returns whether all consist of samples and are as large
/// as the block's.
template <class Real>
SCHLIEREN_HD bool readLeaves(const MediumView<NumberOf<Real>>& medium, const LeavesOfPack<Real>& in,
  const typename LeavesOfPack<Real>::Mask& goes, const Vec3<Real>& places,
  BlockOfLeaves<Real>& block)
{
  using Number = NumberOf<Real>;
  using Whole = typename LeavesOfPack<Real>::Whole;
  constexpr int edge = BlockOfLeaves<Real>::edge;
  typename BlockOfLeaves<Real>::Place place;
  block.find(medium, places, place);
  std::int32_t leaves[lanesOf<Real>];
  std::memcpy(leaves, &place.leaf, sizeof(leaves));
  bool areAllGood = true;
  for (unsigned left = bitsOf(goes & place.isUnknown); left != 0; left &= left - 1)
  {
    const int i = leaves[__builtin_ctz(left)];
    if (block.value[i] == block.value[i])
    {
      continue; // found for another ray
    }
    const Whole at[3] = { block.at[0] + (i & 1), block.at[1] + (i >> 1 & 1),
      block.at[2] + (i >> 2) };
    double middle[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      middle[axis] =
        (static_cast<double>(at[axis]) + 0.5) * static_cast<double>(block.size) * in.unit;
    }
    const Leaf<Number>& leaf = medium.leaves[medium.finder.at({ middle[0], middle[1], middle[2] })];
    bool isGood = leaf.kind == Leaf<Number>::Samples;
    for (int axis = 0; axis < 3; ++axis)
    {
      isGood = isGood &&
        static_cast<Whole>(leaf.first[axis] * in.perUnit) ==
          at[axis] * block.size + block.size / (2 * edge);
    }
    if (!isGood)
    {
      areAllGood = false;
      continue;
    }
    block.value[i] = leaf.offset;
    block.brick[i] = leaf.brick;
  }
  return areAllGood;
}

/// Sets where the domain ends for rays in a block, and whether a step may lead there.
template <class Real>
SCHLIEREN_HD void findEnds(const MediumView<NumberOf<Real>>& medium,
  const typename LeavesOfPack<Real>::There& there, const NumberOf<Real>& reach,
  const LeavesOfPack<Real>& in, RaysInBlock<Real>& rays)
{
  using Number = NumberOf<Real>;
  constexpr int edge = BlockOfLeaves<Real>::edge;
  const auto scale = static_cast<double>(there.perIndex) * in.unit;
  Number low[3], high[3];
  const double last[3] = { medium.last.x, medium.last.y, medium.last.z };
  rays.someNearEnd = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = static_cast<Number>(-static_cast<double>(there.first[axis]) * scale);
    high[axis] = static_cast<Number>(
      (last[axis] * in.perUnit - static_cast<double>(there.first[axis])) * scale);
    rays.someNearEnd |=
      !(low[axis] + reach < Number(-0.5)) || !(high[axis] - reach > Number(2 * edge - 0.5));
  }
  rays.low = { Real{} + low[0], Real{} + low[1], Real{} + low[2] };
  rays.high = { Real{} + high[0], Real{} + high[1], Real{} + high[2] };
}

/// Puts the rays that are under way into a block with all leaves that they look at. Returns whether there is one.
/// `reach`: local coordinates that a step may lead to at most.
template <class Real>
SCHLIEREN_NOINLINE bool takeBlock(const MediumView<NumberOf<Real>>& medium,
  const NumberOf<Real> (&perLength)[3][lanesOf<Real>], const NumberOf<Real>& reach,
  LeavesOfPack<Real>& in, BlockOfLeaves<Real>& block, RaysInBlock<Real>& rays)
{
  using Leaves = LeavesOfPack<Real>;
  using Number = NumberOf<Real>;
  using Mask = typename Leaves::Mask;
  using Whole = typename Leaves::Whole;
  constexpr int edge = BlockOfLeaves<Real>::edge;
  const Mask goes = rays.isUnderWay > 0;
  const unsigned bits = bitsOf(goes);
  if (bits == 0)
  {
    return false;
  }
  Number voxels[lanesOf<Real>];
  toArray(in.voxel, voxels);
  const int one = __builtin_ctz(bits);
  const Number voxel = voxels[one];
  if (any(goes & (in.voxel != voxel)))
  {
    return false;
  }
  const auto size = static_cast<Whole>(edge * static_cast<double>(voxel) * in.perUnit);
  const int logSize = __builtin_ctzll(static_cast<unsigned long long>(size));
  Whole begins[3];
  if (!findCorner(in, rays, goes, one, logSize, begins))
  {
    return false;
  }
  block.beginAt(size, begins);

  typename Leaves::There there;
  there.voxel = voxel;
  there.perIndex = 1 / voxel;
  for (int axis = 0; axis < 3; ++axis)
  {
    there.first[axis] = begins[axis] * size + size / (2 * edge);
  }
  const Vec3<Real> places = moveInto(there, perLength, goes, in, rays);
  const bool areAllGood = readLeaves(medium, in, goes, places, block);
  findEnds(medium, there, reach, in, rays);
  return areAllGood;
}

/// Puts the rays into the leaves that begin at `first`, in units of LeavesOfPack.
template <class Real>
SCHLIEREN_NOINLINE void leaveBlock(const MediumView<NumberOf<Real>>& medium,
  const StepsInLeaves<NumberOf<Real>>& steps, const NumberOf<Real> (&perLength)[3][lanesOf<Real>],
  const typename LeavesOfPack<Real>::Mask (&first)[3], LeavesOfPack<Real>& in,
  RaysInBlock<Real>& rays)
{
  using Leaves = LeavesOfPack<Real>;
  using Mask = typename Leaves::Mask;
  constexpr int lanes = lanesOf<Real>;
  const Mask goes = rays.isUnderWay > 0;
  NumberOf<Real> lengths[lanes];
  toArray(goes ? rays.length : Real{}, lengths);
  for (int i = 0; i < lanes; ++i)
  {
    in.travelled[i] += static_cast<double>(lengths[i]);
  }
  typename Leaves::Whole corner[3][lanes];
  std::memcpy(corner, first, sizeof(corner));
  const Real voxel = in.voxel;
  Mask left = goes;
  for (unsigned bits = bitsOf(left); bits != 0; bits = bitsOf(left))
  {
    const int i = __builtin_ctz(bits);
    double index[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      index[axis] = static_cast<double>(corner[axis][i]) * in.unit;
    }
    const std::int32_t number = medium.finder.at({ index[0], index[1], index[2] });
    if (in.latest.number != number)
    {
      in.latest.read(medium, steps, in.perUnit, number);
    }
    const Mask isIt =
      left & (first[0] == corner[0][i]) & (first[1] == corner[1][i]) & (first[2] == corner[2][i]);
    in.put(in.latest, isIt);
    left &= ~isIt;
  }
  rays.finer = in.perIndex * voxel;
  const Vec3<Real> start = in.starts(perLength);
  rays.start.x = goes ? start.x : rays.start.x;
  rays.start.y = goes ? start.y : rays.start.y;
  rays.start.z = goes ? start.z : rays.start.z;
  rays.length = goes ? Real{} : rays.length;
}

} // namespace schlieren
