// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where rays meet walls.
#pragma once

#include "Rays/March/LeafOfRay.h"

#include <cstdint>

namespace schlieren
{

SCHLIEREN_HD Place placeAt(const GasEdge& edge)
{
  return !(edge.distance < 0) ? Place::Gas : (edge.isWindow ? Place::Window : Place::Wall);
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
  if (leaf.kind != Leaf<Number>::Mixed)
  {
    return leaf.kind == Leaf<Number>::Solid;
  }
  return placeAt(gasEdge(medium, leaf.map * medium.brickStride,
           static_cast<Vec3<Number>>(leaf.toLocal(index)))) == Place::Wall;
}

} // namespace schlieren
