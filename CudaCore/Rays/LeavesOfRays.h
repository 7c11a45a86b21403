// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Interpolation.h"

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
template <class Number, int Lanes>
struct LeavesOfRays
{
  alignas(64) std::int64_t base[Lanes]; ///< where each leaf's samples begin
  std::int32_t leaf[Lanes];
  double start[3][Lanes];  ///< local coordinates where the ray's length is 0
  double travelled[Lanes]; ///< up to there, since the ray entered the domain

  using View = MediumView<Number>;

  SCHLIEREN_HD void enter(const View& medium, int i, const double (&index)[3][Lanes])
  {
    set(medium, i, medium.finder.at({ index[0][i], index[1][i], index[2][i] }));
    const Leaf<Number>& now = medium.leaves[leaf[i]];
    travelled[i] = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      start[axis][i] = (index[axis][i] - now.first[axis]) * now.perIndex;
    }
  }

  /// The leaf of a place in local coordinates of ray i's leaf. The place is made one of the found leaf's
  /// coordinates; `finer`: these by the old ones.
  SCHLIEREN_HD const Leaf<Number>& leafAt(
    const View& medium, int i, Number (&x)[3][Lanes], Number& finer) const
  {
    const Leaf<Number>& now = medium.leaves[leaf[i]];
    const double last[3] = { medium.last.x, medium.last.y, medium.last.z };
    double index[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double at = now.first[axis] + static_cast<double>(x[axis][i]) / now.perIndex;
      index[axis] = at > 0 ? (at < last[axis] ? at : last[axis]) : 0;
    }
    const Leaf<Number>& found =
      medium.leaves[medium.finder.at({ index[0], index[1], index[2] })];
    finer = static_cast<Number>(found.perIndex / now.perIndex);
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis][i] = static_cast<Number>((index[axis] - found.first[axis]) * found.perIndex);
    }
    return found;
  }

  /// Moves ray i, which is at `x` (local coordinates) and goes along `along`, into the leaf of the middle of its next
  /// step. Where steps are shorter there (`usual`), so is this one. Returns the new local coordinates by the old
  /// ones, or 0 if it stays where it is.
  SCHLIEREN_HD double change(const View& medium, int i, const StepsInLeaves<Number>& usual,
    const Number (&x)[3][Lanes], const Number (&along)[3][Lanes], Number& step, Number length,
    const Number (&perLength)[3][Lanes])
  {
    const Leaf<Number>& now = medium.leaves[leaf[i]];
    const auto leafOfMiddle = [&](double ofStep)
    {
      double index[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        index[axis] = now.first[axis] +
          (static_cast<double>(x[axis][i]) + 0.5 * ofStep * static_cast<double>(along[axis][i])) /
            now.perIndex;
      }
      return medium.finder.at({ index[0], index[1], index[2] });
    };
    std::int32_t next = leafOfMiddle(static_cast<double>(step));
    const Number there = usual.in(medium.leaves[next]);
    if (there < step)
    {
      step = there;
      next = leafOfMiddle(static_cast<double>(step));
    }
    if (next == leaf[i])
    {
      return 0;
    }
    const Leaf<Number>& then = medium.leaves[next];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double local = start[axis][i] +
        static_cast<double>(length) * static_cast<double>(perLength[axis][i]) * now.perIndex;
      start[axis][i] = (now.first[axis] + local / now.perIndex - then.first[axis]) * then.perIndex;
    }
    travelled[i] += static_cast<double>(length);
    const double ratio = then.perIndex / now.perIndex;
    set(medium, i, next);
    return ratio;
  }

  /// An offset in the leaf's local coordinates, in index coordinates.
  SCHLIEREN_HD void toIndexCoordinates(const View& medium, int i, Number (&offset)[3][Lanes]) const
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
  const GasEdge edge = gasEdge(medium, leaf.map * medium.brickStride, at);
  return !(edge.distance < 0) ? Place::Gas : (edge.isWindow ? Place::Window : Place::Wall);
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
  const auto local = [&](double x, int axis)
  {
    const double at = (x - leaf.first[axis]) * leaf.perIndex;
    return static_cast<Number>(at);
  };
  const Vec3<Number> at = { local(index.x, 0), local(index.y, 1), local(index.z, 2) };
  return placeIn(medium, leaf, at) == Place::Wall;
}

} // namespace schlieren
