// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/HomogeneityMap.h"

#include "Device/Parallel.h"

namespace schlieren
{

namespace
{

constexpr std::int64_t cubesPerPiece = 256;

/// Whether any of the `count` <= 32 bits from `at` on is 1.
bool anyBit(const std::uint32_t* bits, std::int64_t at, int count)
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
void widen(Real (&lowest)[brickEdge], Real (&highest)[brickEdge], const Real* row)
{
#if defined(__GNUC__) && !defined(__clang__)
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
NuRange<Real> rangeOfBrick(const MediumView<Real>& m, const BrickPyramid& pyramid, std::int64_t n)
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
  // Neighbours at once: a row's first points and, overlapping them, its last ones.
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
NuRange<Real> rangeOfCube(
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
std::uint8_t levelOfBrick(
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

template <class Scheme, class Real>
void boundBricks(const MediumView<Real>& medium, HomogeneityMap<Real>& map, int threads)
{
  parallelFor(map.pyramid.size(0), cubesPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t n = begin; n < end; ++n)
      {
        map.ranges[static_cast<std::size_t>(n)] = rangeOfBrick<Scheme>(medium, map.pyramid, n);
      }
    });
}

} // namespace

BrickPyramid pyramidOver(const std::array<std::int64_t, 3>& dimensions)
{
  BrickPyramid pyramid{ {}, {}, 1 };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    pyramid.cells[axis] = dimensions[axis] - 1;
    pyramid.bricks[axis] = (pyramid.cells[axis] - 1) / brickEdge + 1;
  }
  while (pyramid.size(pyramid.levels - 1) > 1)
  {
    ++pyramid.levels;
  }
  return pyramid;
}

template <class Real>
void HomogeneityMap<Real>::setTolerance(Real tolerance, int threads)
{
  parallelFor(pyramid.size(0), cubesPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t n = begin; n < end; ++n)
      {
        levels[static_cast<std::size_t>(n)] = levelOfBrick(ranges.data(), pyramid, tolerance, n);
      }
    });
}

template <class Real>
HomogeneityView HomogeneityMap<Real>::view() const
{
  return { levels.data(), { pyramid.bricks[0], pyramid.bricks[1], pyramid.bricks[2] } };
}

template <class Real>
HomogeneityMap<Real> buildHomogeneityMap(
  const Medium<Real>& medium, Interpolation interpolation, Real tolerance, int threads)
{
  const BrickPyramid pyramid = pyramidOver(medium.volume.dimensions);
  HomogeneityMap<Real> map{ pyramid,
    std::vector<NuRange<Real>>(static_cast<std::size_t>(pyramid.first(pyramid.levels))),
    std::vector<std::uint8_t>(static_cast<std::size_t>(pyramid.size(0))) };
  visitScheme(interpolation,
    [&](auto scheme) { boundBricks<decltype(scheme)>(medium.view(), map, threads); });
  for (int level = 1; level < pyramid.levels; ++level)
  {
    NuRange<Real>* ranges = map.ranges.data() + pyramid.first(level);
    parallelFor(pyramid.size(level), cubesPerPiece, threads,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t n = begin; n < end; ++n)
        {
          ranges[n] = rangeOfCube(map.ranges.data(), pyramid, level, n);
        }
      });
  }
  map.setTolerance(tolerance, threads);
  return map;
}

template struct HomogeneityMap<float>;
template struct HomogeneityMap<double>;
template HomogeneityMap<float> buildHomogeneityMap(const Medium<float>&, Interpolation, float, int);
template HomogeneityMap<double> buildHomogeneityMap(
  const Medium<double>&, Interpolation, double, int);

} // namespace schlieren
