// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/HomogeneityMap.h"

#include "Device/Parallel.h"

namespace schlieren
{

namespace
{

constexpr std::int64_t cubesPerPiece = 256;

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
