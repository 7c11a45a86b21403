// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where a ray may go far in one step because hardly anything changes there: a min-max pyramid over the
// medium and, made from it for a tolerance, the homogeneity map (the octree texture of Brownlee et al.
// 2011, section 4.2, but with a level per brick, not per voxel).
//
//   brick    a cube of brickEdge^3 cells of the grid; along an axis, brick b reaches from b * brickEdge
//            to (b + 1) * brickEdge in index coordinates, the last one perhaps past the grid
//   pyramid  level l bounds the medium in aligned cubes of 2^l bricks a side; its last level has one
//   map      one byte per brick: how many levels of the pyramid, from the finest up, are homogeneous
//            around it, 0 = none
#pragma once

#include "Medium/Medium.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace schlieren
{

/// Edge in cells. Larger ones find clearly less to skip in real flows, and these cost but 4 % of the medium's
/// memory (Documentation/development/performance.md).
constexpr int brickEdge = 4;

template <class Real>
constexpr Real infinite = std::numeric_limits<Real>::infinity();

/// Bounds of nu in a cube, its faces included: of the samples that have any weight there, so that no
/// interpolated nu is outside by more than the interpolation's rounding. Infinite where one of the grid
/// points is solid.
///
/// They bound what rays feel, too. The derivative by an index coordinate is a mean, without negative
/// weights, of differences of neighbouring samples, so that each |d nu / d index| in the cube is at most
/// s = Scheme::steepest * (highest - lowest). Hence, along a straight segment of length L within it, in
/// whatever unit, the integral
///   - of d nu / d index is at most s L: that much a ray misses that is not bent there, along each axis;
///   - of d nu / d index differs from L times the derivative at the segment's middle by at most 2 s L:
///     what a ray misses that is bent once (less by far, of second order, where the medium is smooth);
///   - of nu differs from L times nu at the middle by at most L * (highest - lowest).
/// No smaller factors hold for all media. A face belongs to the cube above it, as it does for
/// homogeneousCube.
template <class Real>
struct NuRange
{
  Real lowest, highest;

  SCHLIEREN_HD void include(const NuRange& other)
  {
    lowest = other.lowest < lowest ? other.lowest : lowest;
    highest = other.highest > highest ? other.highest : highest;
  }

  /// Never true of solids, however large the tolerance.
  SCHLIEREN_HD bool isWithin(Real tolerance) const
  {
    return lowest > -infinite<Real> && highest - lowest <= tolerance;
  }
};

/// The cubes of all levels, numbered level by level from the finest, x fastest.
struct BrickPyramid
{
  std::int64_t cells[3];  ///< of the grid, along each axis
  std::int64_t bricks[3]; ///< on the finest level, along each axis
  int levels;             ///< the last one has a single cube

  struct Place
  {
    std::int64_t x, y, z;
  };

  SCHLIEREN_HD std::int64_t along(int axis, int level) const
  {
    return ((bricks[axis] - 1) >> level) + 1;
  }

  SCHLIEREN_HD std::int64_t size(int level) const
  {
    return along(0, level) * along(1, level) * along(2, level);
  }

  /// The number of the level's first cube; of `levels`: how many there are.
  SCHLIEREN_HD std::int64_t first(int level) const
  {
    std::int64_t sum = 0;
    for (int finer = 0; finer < level; ++finer)
    {
      sum += size(finer);
    }
    return sum;
  }

  /// The place, in cubes of its level, of the cube with the number first(level) + n.
  SCHLIEREN_HD Place place(std::int64_t n, int level) const
  {
    const std::int64_t nx = along(0, level);
    const std::int64_t row = n / nx;
    return { n % nx, row % along(1, level), row / along(1, level) };
  }

  SCHLIEREN_HD std::int64_t number(const Place& at, int level) const
  {
    return (at.z * along(1, level) + at.y) * along(0, level) + at.x;
  }
};

BrickPyramid pyramidOver(const std::array<std::int64_t, 3>& dimensions);

/// What a ray needs of the map.
struct HomogeneityView
{
  const std::uint8_t* levels; ///< per brick, x fastest
  std::int64_t bricks[3];
};

/// A cube in index coordinates; none where the edge is 0. It may reach past the grid.
template <class Real>
struct HomogeneousCube
{
  Vec3<Real> low;
  Real edge;
};

/// The largest homogeneous cube around a position within [0, last]: within it and within the grid no
/// ray meets a solid, and nu varies by no more than the tolerance.
template <class Real>
SCHLIEREN_HD HomogeneousCube<Real> homogeneousCube(
  const HomogeneityView& map, const Vec3<Real>& position)
{
  const Real x[3] = { position.x, position.y, position.z };
  std::int64_t brick[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t b = static_cast<std::int64_t>(x[axis]) / brickEdge;
    brick[axis] = b < map.bricks[axis] ? b : map.bricks[axis] - 1; // the grid's far faces
  }
  const int level =
    map.levels[(brick[2] * map.bricks[1] + brick[1]) * map.bricks[0] + brick[0]] - 1;
  if (level < 0)
  {
    return { { 0, 0, 0 }, 0 };
  }
  const auto low = [&](int axis)
  { return static_cast<Real>(((brick[axis] >> level) << level) * brickEdge); };
  return { { low(0), low(1), low(2) }, static_cast<Real>(std::int64_t{ brickEdge } << level) };
}

/// The pyramid and the map.
template <class Real>
struct HomogeneityMap
{
  BrickPyramid pyramid;
  std::vector<NuRange<Real>> ranges; ///< of all the pyramid's cubes
  std::vector<std::uint8_t> levels;  ///< per brick

  /// Makes the map for another tolerance, the largest difference of nu within a cube that counts as
  /// homogeneous. The pyramid stays: this takes next to no time.
  void setTolerance(Real tolerance, int threads);

  HomogeneityView view() const;
};

/// `interpolation` is the one that the medium was built for.
template <class Real>
HomogeneityMap<Real> buildHomogeneityMap(
  const Medium<Real>& medium, Interpolation interpolation, Real tolerance, int threads);

} // namespace schlieren
