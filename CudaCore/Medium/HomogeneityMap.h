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

/// In cells. Larger ones find clearly less to skip in real flows, and these cost but 4 % of the medium's
/// memory (Documentation/performance.md).
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
/// homogeneousCube and for Linear's derivative, which jumps there.
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

// One cube's part of the work, the same on host and device.

/// Whether any of the `count` <= 32 bits from `at` on is 1.
SCHLIEREN_HD bool anyBit(const std::uint32_t* bits, std::int64_t at, int count)
{
  const int shift = static_cast<int>(at & 31);
  std::uint64_t window = bits[at >> 5] >> shift;
  if (shift + count > 32)
  {
    window |= std::uint64_t{ bits[(at >> 5) + 1] } << (32 - shift);
  }
  return (window & ((std::uint64_t{ 1 } << count) - 1)) != 0;
}

/// Widens one range per neighbour.
template <class Real>
SCHLIEREN_HD void widen(Real (&lowest)[brickEdge], Real (&highest)[brickEdge], const Real* row)
{
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#pragma GCC unroll 1 // once it has unrolled the loop, GCC does not vectorise it any more
#endif
  for (int i = 0; i < brickEdge; ++i)
  {
    lowest[i] = row[i] < lowest[i] ? row[i] : lowest[i];
    highest[i] = row[i] > highest[i] ? row[i] : highest[i];
  }
}

/// The n-th brick.
template <class Scheme, class Real>
SCHLIEREN_HD NuRange<Real> rangeOfBrick(
  const MediumView<Real>& m, const BrickPyramid& pyramid, std::int64_t n)
{
  const BrickPyramid::Place place = pyramid.place(n, 0);
  const std::int64_t low[3] = { place.x * brickEdge, place.y * brickEdge, place.z * brickEdge };
  int points[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t rest = pyramid.cells[axis] - low[axis];
    points[axis] = static_cast<int>(rest < brickEdge ? rest : brickEdge) + 1;
  }

  if (m.solid != nullptr)
  {
    // Past the ghost layer.
    const std::int64_t corner =
      (low[2] + 1) * m.planeStride + (low[1] + 1) * m.rowStride + low[0] + 1;
    for (int k = 0; k < points[2]; ++k)
    {
      for (int j = 0; j < points[1]; ++j)
      {
        if (anyBit(m.solid, corner + k * m.planeStride + j * m.rowStride, points[0]))
        {
          return { -infinite<Real>, infinite<Real> };
        }
      }
    }
  }

  constexpr int first = 1 - Scheme::reach;
  const Real* corner =
    m.samples + (low[2] + first) * m.planeStride + (low[1] + first) * m.rowStride + low[0] + first;
  const int width = points[0] + 2 * Scheme::reach;
  const int height = points[1] + 2 * Scheme::reach;
  const int depth = points[2] + 2 * Scheme::reach;
  NuRange<Real> range{ infinite<Real>, -infinite<Real> };
  if (width < brickEdge)
  {
    for (int k = 0; k < depth; ++k)
    {
      for (int j = 0; j < height; ++j)
      {
        const Real* row = corner + k * m.planeStride + j * m.rowStride;
        for (int i = 0; i < width; ++i)
        {
          range.include({ row[i], row[i] });
        }
      }
    }
    return range;
  }
  // For the CPU, neighbours at once: a row's first points and, overlapping them, its last ones.
  static_assert(brickEdge + 1 + 2 * Scheme::reach <= 2 * brickEdge);
  Real lowest[2][brickEdge], highest[2][brickEdge];
  for (int i = 0; i < brickEdge; ++i)
  {
    lowest[0][i] = lowest[1][i] = infinite<Real>;
    highest[0][i] = highest[1][i] = -infinite<Real>;
  }
  for (int k = 0; k < depth; ++k)
  {
    const Real* plane = corner + k * m.planeStride;
    for (int j = 0; j < height; ++j)
    {
      const Real* row = plane + j * m.rowStride;
      widen(lowest[0], highest[0], row);
      widen(lowest[1], highest[1], row + width - brickEdge);
    }
  }
  for (int i = 0; i < brickEdge; ++i)
  {
    range.include({ lowest[0][i], highest[0][i] });
    range.include({ lowest[1][i], highest[1][i] });
  }
  return range;
}

/// The n-th cube of a level above the finest, from those of the level below; `ranges` are the
/// pyramid's.
template <class Real>
SCHLIEREN_HD NuRange<Real> rangeOfCube(
  const NuRange<Real>* ranges, const BrickPyramid& pyramid, int level, std::int64_t n)
{
  const BrickPyramid::Place at = pyramid.place(n, level);
  const NuRange<Real>* finer = ranges + pyramid.first(level - 1);
  NuRange<Real> range = finer[pyramid.number({ 2 * at.x, 2 * at.y, 2 * at.z }, level - 1)];
  for (std::int64_t z = 2 * at.z; z < 2 * at.z + 2 && z < pyramid.along(2, level - 1); ++z)
  {
    for (std::int64_t y = 2 * at.y; y < 2 * at.y + 2 && y < pyramid.along(1, level - 1); ++y)
    {
      for (std::int64_t x = 2 * at.x; x < 2 * at.x + 2 && x < pyramid.along(0, level - 1); ++x)
      {
        range.include(finer[pyramid.number({ x, y, z }, level - 1)]);
      }
    }
  }
  return range;
}

/// What the map holds of the n-th brick.
template <class Real>
SCHLIEREN_HD std::uint8_t levelOfBrick(
  const NuRange<Real>* ranges, const BrickPyramid& pyramid, Real tolerance, std::int64_t n)
{
  const BrickPyramid::Place at = pyramid.place(n, 0);
  int level = 0;
  std::int64_t first = 0;
  while (level < pyramid.levels &&
    ranges[first + pyramid.number({ at.x >> level, at.y >> level, at.z >> level }, level)].isWithin(
      tolerance))
  {
    first += pyramid.size(level);
    ++level;
  }
  return static_cast<std::uint8_t>(level);
}

} // namespace schlieren
