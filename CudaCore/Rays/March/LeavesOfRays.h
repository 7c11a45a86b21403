// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Samples/Interpolation.h"

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

/// Which leaves of a tree some rays are in. The undisturbed rays are followed in doubles from leaf to leaf, so
/// that nothing is lost however many there are.
template <class Real>
struct LeavesOfRays
{
  using Number = NumberOf<Real>;
  static constexpr int lanes = lanesOf<Real>;

  alignas(64) std::int64_t base[lanes]; ///< where each leaf's samples begin
  std::int32_t leaf[lanes];
  double start[3][lanes];  ///< local coordinates where the ray's length is 0
  double travelled[lanes]; ///< up to there, since the ray entered the domain

  using View = MediumView<Number>;

  SCHLIEREN_HD void enter(const View& medium, int i, const double (&index)[3][lanes])
  {
    set(medium, i, medium.finder.at({ index[0][i], index[1][i], index[2][i] }));
    const Leaf<Number>& now = medium.leaves[leaf[i]];
    travelled[i] = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      start[axis][i] = now.toLocal(axis, index[axis][i]);
    }
  }

  /// The leaf of a place in local coordinates of ray i's leaf. The place is made one of the found leaf's
  /// coordinates; `finer`: these by the old ones.
  SCHLIEREN_HD const Leaf<Number>& leafAt(
    const View& medium, int i, Number (&x)[3][lanes], Number& finer) const
  {
    const Leaf<Number>& now = medium.leaves[leaf[i]];
    const double last[3] = { medium.last.x, medium.last.y, medium.last.z };
    double index[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double at = now.toIndex(axis, static_cast<double>(x[axis][i]));
      index[axis] = at > 0 ? (at < last[axis] ? at : last[axis]) : 0;
    }
    const Leaf<Number>& found = medium.leaves[medium.finder.at({ index[0], index[1], index[2] })];
    finer = static_cast<Number>(found.perIndex / now.perIndex);
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis][i] = static_cast<Number>(found.toLocal(axis, index[axis]));
    }
    return found;
  }

  /// The leaf of the middle of the next step of ray i, which is at `x` (local coordinates) and goes along `along`. Where
  /// steps are shorter there (`usual`), so is this one.
  SCHLIEREN_HD std::int32_t next(const View& medium, int i, const StepsInLeaves<Number>& usual,
    const Number (&x)[3][lanes], const Number (&along)[3][lanes], Number& step) const
  {
    const Leaf<Number>& now = medium.leaves[leaf[i]];
    const auto leafOfMiddle = [&](double ofStep)
    {
      double index[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        index[axis] = now.toIndex(axis,
          static_cast<double>(x[axis][i]) + 0.5 * ofStep * static_cast<double>(along[axis][i]));
      }
      return medium.finder.at({ index[0], index[1], index[2] });
    };
    const std::int32_t found = leafOfMiddle(static_cast<double>(step));
    const Number there = usual.in(medium.leaves[found]);
    if (there < step)
    {
      step = there;
      return leafOfMiddle(static_cast<double>(step));
    }
    return found;
  }

  /// Moves ray i into a leaf. Returns the new local coordinates by the old ones.
  SCHLIEREN_HD double change(
    const View& medium, int i, std::int32_t to, Number length, const Number (&perLength)[3][lanes])
  {
    const Leaf<Number>& now = medium.leaves[leaf[i]];
    const Leaf<Number>& then = medium.leaves[to];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double local = start[axis][i] +
        static_cast<double>(length) * static_cast<double>(perLength[axis][i]) * now.perIndex;
      start[axis][i] = then.toLocal(axis, now.toIndex(axis, local));
    }
    travelled[i] += static_cast<double>(length);
    const double ratio = then.perIndex / now.perIndex;
    set(medium, i, to);
    return ratio;
  }

  /// An offset in the leaf's local coordinates, in index coordinates.
  SCHLIEREN_HD void toIndexCoordinates(const View& medium, int i, Number (&offset)[3][lanes]) const
  {
    const double perIndex = medium.leaves[leaf[i]].perIndex;
    for (int axis = 0; axis < 3; ++axis)
    {
      offset[axis][i] = static_cast<Number>(static_cast<double>(offset[axis][i]) / perIndex);
    }
  }

private:
  SCHLIEREN_HD void set(const View& medium, int i, std::int32_t number)
  {
    leaf[i] = number;
    base[i] = medium.leaves[number].brick * medium.brickStride;
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
  Real isNearEdge;      ///< 1 where gas may end, else 0
  bool someConstant;    ///< of the rays that are under way
  bool someNearEdge;    ///< likewise: gas may end
  bool someNearEnd;     ///< likewise: the leaf is at a side of the domain
};

// The functions from here on are no members of what holds the rays: it would be kept in memory, in every step.

template <class Real>
SCHLIEREN_HD Vec3<Real> packsOf(const NumberOf<Real> (&from)[3][lanesOf<Real>])
{
  return { fromArray<Real>(from[0]), fromArray<Real>(from[1]), fromArray<Real>(from[2]) };
}

template <class Real>
SCHLIEREN_HD void toArrays(const Vec3<Real>& from, NumberOf<Real> (&to)[3][lanesOf<Real>])
{
  toArray(from.x, to[0]);
  toArray(from.y, to[1]);
  toArray(from.z, to[2]);
}

/// `step`: the steps so far, 0 for rays that are not under way.
template <class Real>
SCHLIEREN_NOINLINE void readLeaves(const MediumView<NumberOf<Real>>& medium,
  const StepsInLeaves<NumberOf<Real>>& steps, const LeavesOfRays<Real>& in, const Real& step,
  LeavesInPacks<Real>& to)
{
  using Number = NumberOf<Real>;
  constexpr int lanes = lanesOf<Real>;
  Number value[lanes], perIndex[lanes], low[3][lanes], high[3][lanes], usual[lanes],
    isConstant[lanes], isNearEdge[lanes];
  const double last[3] = { medium.last.x, medium.last.y, medium.last.z };
  toArray(step, usual);
  to.someConstant = false;
  to.someNearEdge = false;
  to.someNearEnd = true;
  for (int i = 0; i < lanes; ++i)
  {
    const Leaf<Number>& leaf = medium.leaves[in.leaf[i]];
    value[i] = leaf.offset;
    perIndex[i] = static_cast<Number>(leaf.perIndex);
    const bool mayEnd = leaf.kind == Leaf<Number>::Mixed || leaf.kind == Leaf<Number>::Solid;
    isConstant[i] = leaf.kind == Leaf<Number>::Constant ? Number(1) : Number(0);
    isNearEdge[i] = mayEnd ? Number(1) : Number(0);
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis][i] = static_cast<Number>(leaf.toLocal(axis, 0));
      high[axis][i] = static_cast<Number>(leaf.toLocal(axis, last[axis]));
    }
    if (usual[i] > 0)
    {
      usual[i] = steps.in(leaf);
      to.someConstant = to.someConstant || leaf.kind == Leaf<Number>::Constant;
      to.someNearEdge = to.someNearEdge || mayEnd;
    }
  }
  to.value = fromArray<Real>(value);
  to.perIndex = fromArray<Real>(perIndex);
  to.low = packsOf<Real>(low);
  to.high = packsOf<Real>(high);
  to.step = fromArray<Real>(usual);
  to.isConstant = fromArray<Real>(isConstant);
  to.isNearEdge = fromArray<Real>(isNearEdge);
}

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

/// Moves the rays in question into the leaves of the middle of their next step, see LeavesOfRays::next. Whether any ray
/// has changed its leaf.
template <class Real>
SCHLIEREN_NOINLINE bool changeLeaves(const MediumView<NumberOf<Real>>& medium,
  const StepsInLeaves<NumberOf<Real>>& steps, const NumberOf<Real> (&perLength)[3][lanesOf<Real>],
  LeavesOfRays<Real>& in, RaysBetweenLeaves<Real>& rays)
{
  using Number = NumberOf<Real>;
  constexpr int lanes = lanesOf<Real>;
  Number isOut[lanes], step[lanes], length[lanes], finer[lanes], x[3][lanes], along[3][lanes],
    start[3][lanes];
  toArray(rays.isOut, isOut);
  toArray(rays.step, step);
  toArray(rays.length, length);
  toArrays(rays.x, x);
  toArrays(rays.along, along);
  toArrays(rays.start, start);
  bool hasChanged = false;
  for (int i = 0; i < lanes; ++i)
  {
    finer[i] = 1;
    if (isOut[i] == 0)
    {
      continue;
    }
    const std::int32_t to = in.next(medium, i, steps, x, along, step[i]);
    if (to == in.leaf[i])
    {
      continue;
    }
    hasChanged = true;
    finer[i] = static_cast<Number>(in.change(medium, i, to, length[i], perLength));
    length[i] = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      start[axis][i] = static_cast<Number>(in.start[axis][i]);
    }
  }
  rays.step = fromArray<Real>(step);
  rays.length = fromArray<Real>(length);
  rays.finer = fromArray<Real>(finer);
  rays.start = packsOf<Real>(start);
  return hasChanged;
}

/// Where a pack of places lies that may be in other leaves than the rays.
template <class Real>
struct PlacesElsewhere
{
  alignas(64) std::int64_t base[lanesOf<Real>];
  Vec3<Real> at; ///< local coordinates of the leaf that each is in
  Real value;    ///< see LeavesInPacks
  Real finer;    ///< these local coordinates by those of the rays' leaves
};
template <class Real>
SCHLIEREN_NOINLINE void findElsewhere(const MediumView<NumberOf<Real>>& medium,
  const LeavesOfRays<Real>& in, const Vec3<Real>& at, PlacesElsewhere<Real>& to)
{
  using Number = NumberOf<Real>;
  constexpr int lanes = lanesOf<Real>;
  Number x[3][lanes], value[lanes], finer[lanes];
  toArrays(at, x);
  for (int i = 0; i < lanes; ++i)
  {
    const Leaf<Number>& leaf = in.leafAt(medium, i, x, finer[i]);
    to.base[i] = leaf.brick * medium.brickStride;
    value[i] = leaf.offset;
  }
  to.at = packsOf<Real>(x);
  to.value = fromArray<Real>(value);
  to.finer = fromArray<Real>(finer);
}

SCHLIEREN_HD Place placeAt(const GasEdge& edge)
{
  return !(edge.distance < 0) ? Place::Gas : (edge.isWindow ? Place::Window : Place::Wall);
}

/// What there is at a place in local coordinates of a leaf.
template <class Number>
SCHLIEREN_HD Place placeIn(
  const MediumView<Number>& medium, const Leaf<Number>& leaf, const Vec3<Number>& at)
{
  if (leaf.kind == Leaf<Number>::Solid)
  {
    return Place::Wall;
  }
  if (leaf.kind != Leaf<Number>::Mixed)
  {
    return Place::Gas;
  }
  return placeAt(gasEdge(medium, leaf.map * medium.brickStride, at));
}

/// Whether a step meets a wall before or after its middle, `distance` from where gas ends. Distances change no faster
/// than places, so it is looked at more closely only while some of it may be in the wall: what is missed at a
/// sharp edge is less than an eighth of a step long. `half`: from the middle to the step's end, local coordinates.
template <class Number>
SCHLIEREN_HD bool meetsWallBesideMiddle(const MediumView<Number>& medium, const Leaf<Number>& leaf,
  const Vec3<Number>& middle, const Vec3<Number>& half, float distance)
{
  constexpr int finest = 8;              // parts of half a step
  constexpr Number apron = Number(0.49); // around the leaf there is half a voxel more
  const Vec3<Number> beyond = { apron, apron, apron };
  const Vec3<Number> across = { half.x, half.y, medium.planeStride == 0 ? Number(0) : half.z };
  const float lengthSquared = static_cast<float>(dot(across, across));
  float least = distance;
  for (int parts = 2; parts <= finest; parts *= 2)
  {
    const float covered = least * static_cast<float>(parts / 2); // by the parts that were looked at
    if (covered * covered >= lengthSquared)
    {
      return false;
    }
    for (int part = 1 - parts; part < parts; part += 2)
    {
      const Vec3<Number> at =
        middle + (static_cast<Number>(part) / static_cast<Number>(parts)) * across;
      const GasEdge edge = gasEdge(medium, leaf.map * medium.brickStride,
        clampTo(at, medium.leafLow - beyond, medium.leafHigh + beyond));
      if (edge.distance < 0 && !edge.isWindow)
      {
        return true;
      }
      least = edge.distance < least ? edge.distance : least;
    }
  }
  return false;
}

/// Sets `inGas` (1 or 0) of the rays that are under way and take a step in their leaves, from its middle `half` to
/// either end; returns 1 for those that meet a wall, 0 for others.
template <class Real>
SCHLIEREN_NOINLINE Real meetWalls(const MediumView<NumberOf<Real>>& medium,
  const std::int32_t (&leaf)[lanesOf<Real>], const Vec3<Real>& middle, const Vec3<Real>& half,
  const Real& isUnderWay, Real& inGas)
{
  using Number = NumberOf<Real>;
  constexpr int lanes = lanesOf<Real>;
  Number x[3][lanes], toEnd[3][lanes], gas[lanes], mayMeet[lanes], isBlocked[lanes];
  toArrays(middle, x);
  toArrays(half, toEnd);
  toArray(isUnderWay, mayMeet);
  toArray(inGas, gas);
  for (int i = 0; i < lanes; ++i)
  {
    isBlocked[i] = 0;
    if (mayMeet[i] > 0)
    {
      const Leaf<Number>& now = medium.leaves[leaf[i]];
      const Vec3<Number> at = { x[0][i], x[1][i], x[2][i] };
      Place place = now.kind == Leaf<Number>::Solid ? Place::Wall : Place::Gas;
      if (now.kind == Leaf<Number>::Mixed)
      {
        const GasEdge edge = gasEdge(medium, now.map * medium.brickStride, at);
        place = placeAt(edge);
        if (place == Place::Gas &&
          meetsWallBesideMiddle(
            medium, now, at, Vec3<Number>{ toEnd[0][i], toEnd[1][i], toEnd[2][i] }, edge.distance))
        {
          place = Place::Wall;
        }
      }
      isBlocked[i] = place == Place::Wall ? Number(1) : Number(0);
      gas[i] = place == Place::Gas ? Number(1) : Number(0);
    }
  }
  inGas = fromArray<Real>(gas);
  return fromArray<Real>(isBlocked);
}

/// Whether light cannot be at a place of the domain, in index coordinates.
template <class Number>
SCHLIEREN_HD bool isWallAt(const MediumView<Number>& medium, const Vec3<double>& index)
{
  if (medium.leaves == nullptr)
  {
    return medium.solid != nullptr && isSolid(medium, static_cast<Vec3<Number>>(index));
  }
  const Leaf<Number>& leaf = medium.leaves[medium.finder.at(index)];
  const auto local = [&](double x, int axis) { return static_cast<Number>(leaf.toLocal(axis, x)); };
  const Vec3<Number> at = { local(index.x, 0), local(index.y, 1), local(index.z, 2) };
  return placeIn(medium, leaf, at) == Place::Wall;
}

} // namespace schlieren
