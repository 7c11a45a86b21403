// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What the map calls homogeneous is compared with what rays would see there.
#include "Fields.h"
#include "Medium/HomogeneityMap.h"

#include <algorithm>
#include <limits>
#include <random>

namespace schlieren
{

namespace
{

using Dimensions = std::array<std::int64_t, 3>;

constexpr double anyTolerance = std::numeric_limits<double>::infinity();
const Dimensions someDimensions[] = { { 2, 2, 2 }, { 2, 2, 9 }, { 5, 2, 3 }, { 9, 8, 7 },
  { 4, 14, 6 }, { 33, 17, 6 }, { 257, 3, 6 } };

Grid gridOf(const Dimensions& dimensions)
{
  Grid grid;
  grid.dimensions = dimensions;
  return grid;
}

template <class Real>
Medium<Real> mediumOf(const Dimensions& dimensions, Interpolation interpolation,
  const std::function<double(double, double, double)>& refractivity)
{
  SampledField<double> field(gridOf(dimensions), refractivity);
  field.field.ambient = 0;
  return buildMedium<Real>(field.field, interpolation, 1);
}

template <class Real>
Sample<Real> sampleAt(
  const Medium<Real>& medium, Interpolation interpolation, const Vec3<Real>& position)
{
  return visitScheme(interpolation,
    [&](auto scheme) { return interpolate<decltype(scheme)>(medium.view(), position); });
}

double steepestOf(Interpolation interpolation)
{
  return visitScheme(interpolation, [](auto scheme) { return decltype(scheme)::steepest; });
}

/// Calls visit(position) on a lattice of three points a cell that covers the part of an aligned cube
/// within the grid, its faces included.
template <class Visit>
void forPositions(
  const Dimensions& dimensions, const Dimensions& low, std::int64_t edge, const Visit& visit)
{
  constexpr std::int64_t perCell = 3;
  std::int64_t end[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    end[axis] = perCell * (std::min(low[axis] + edge, dimensions[axis] - 1) - low[axis]);
  }
  const auto at = [](std::int64_t from, std::int64_t n)
  { return static_cast<double>(from) + static_cast<double>(n) / perCell; };
  for (std::int64_t k = 0; k <= end[2]; ++k)
  {
    for (std::int64_t j = 0; j <= end[1]; ++j)
    {
      for (std::int64_t i = 0; i <= end[0]; ++i)
      {
        visit(Vec3<double>{ at(low[0], i), at(low[1], j), at(low[2], k) });
      }
    }
  }
}

/// Calls visit(level, low corner, edge, range) for the cubes of all levels.
template <class Real, class Visit>
void forCubes(const HomogeneityMap<Real>& map, const Visit& visit)
{
  for (int level = 0; level < map.pyramid.levels; ++level)
  {
    const std::int64_t edge = std::int64_t{ brickEdge } << level;
    for (std::int64_t n = 0; n < map.pyramid.size(level); ++n)
    {
      const BrickPyramid::Place at = map.pyramid.place(n, level);
      visit(level, Dimensions{ at.x * edge, at.y * edge, at.z * edge }, edge,
        map.ranges[static_cast<std::size_t>(map.pyramid.first(level) + n)]);
    }
  }
}

template <class Real>
void expectBounds(const Dimensions& dimensions, Interpolation interpolation,
  const std::function<double(double, double, double)>& refractivity)
{
  const Medium<Real> medium = mediumOf<Real>(dimensions, interpolation, refractivity);
  const HomogeneityMap<Real> map = buildHomogeneityMap<Real>(medium, interpolation, 0, 1);
  const double rounding =
    32 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * medium.largestNu;
  forCubes(map,
    [&](int, const Dimensions& low, std::int64_t edge, const NuRange<Real>& range)
    {
      const double lowest = static_cast<double>(range.lowest);
      const double highest = static_cast<double>(range.highest);
      double least = anyTolerance, most = -anyTolerance, steepest = 0;
      forPositions(dimensions, low, edge,
        [&](const Vec3<double>& position)
        {
          const Sample<Real> sample =
            sampleAt(medium, interpolation, static_cast<Vec3<Real>>(position));
          least = std::min(least, static_cast<double>(sample.value));
          most = std::max(most, static_cast<double>(sample.value));
          steepest = std::max({ steepest, std::abs(static_cast<double>(sample.gradient.x)),
            std::abs(static_cast<double>(sample.gradient.y)),
            std::abs(static_cast<double>(sample.gradient.z)) });
        });
      EXPECT_GE(least, lowest - rounding);
      EXPECT_LE(most, highest + rounding);
      EXPECT_LE(steepest, steepestOf(interpolation) * (highest - lowest) + rounding);
    });
}

TEST(HomogeneityMap, BoundsWhateverIsInterpolated)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> weak(-1e-9, 1e-9), strong(-0.9, 5);
  for (const Dimensions& dimensions : someDimensions)
  {
    for (const Interpolation interpolation : allInterpolations)
    {
      SCOPED_TRACE(testing::PrintToString(dimensions));
      expectBounds<float>(
        dimensions, interpolation, [&](double, double, double) { return weak(random); });
      expectBounds<double>(
        dimensions, interpolation, [&](double, double, double) { return strong(random); });
      expectBounds<float>(dimensions, interpolation,
        [](double x, double y, double z) { return x == 1 && y == 1 && z == 1 ? 3e-4 : 0; });
    }
  }
}

/// The means along a straight segment.
Sample<double> meanAlong(const Medium<double>& medium, Interpolation interpolation,
  const Vec3<double>& from, const Vec3<double>& to)
{
  constexpr int points = 501;
  Sample<double> sum{ 0, { 0, 0, 0 } };
  for (int i = 0; i < points; ++i)
  {
    const Sample<double> sample =
      sampleAt(medium, interpolation, from + ((i + 0.5) / points) * (to - from));
    sum.value += sample.value / points;
    sum.gradient += (1. / points) * sample.gradient;
  }
  return sum;
}

TEST(HomogeneityMap, BoundsWhatIsMissedAlongSegments)
{
  std::mt19937 random(23);
  std::uniform_real_distribution<double> any(-0.1, 0.1), where(0, 1);
  for (const Dimensions& dimensions : someDimensions)
  {
    for (const Interpolation interpolation : allInterpolations)
    {
      const Medium<double> medium = mediumOf<double>(
        dimensions, interpolation, [&](double, double, double) { return any(random); });
      forCubes(buildHomogeneityMap<double>(medium, interpolation, 0, 1),
        [&](int, const Dimensions& low, std::int64_t edge, const NuRange<double>& range)
        {
          const auto within = [&](std::size_t axis)
          {
            const std::int64_t end = std::min(low[axis] + edge, dimensions[axis] - 1);
            return static_cast<double>(low[axis]) +
              static_cast<double>(end - low[axis]) * where(random);
          };
          const Vec3<double> from{ within(0), within(1), within(2) };
          const Vec3<double> to{ within(0), within(1), within(2) };
          const Sample<double> mean = meanAlong(medium, interpolation, from, to);
          const Sample<double> middle = sampleAt(medium, interpolation, 0.5 * (from + to));
          const double r = range.highest - range.lowest;
          const double s = steepestOf(interpolation) * r;
          EXPECT_LE(std::abs(mean.gradient.x), s);
          EXPECT_LE(std::abs(mean.gradient.y), s);
          EXPECT_LE(std::abs(mean.gradient.z), s);
          EXPECT_LE(std::abs(mean.gradient.x - middle.gradient.x), 2 * s);
          EXPECT_LE(std::abs(mean.gradient.y - middle.gradient.y), 2 * s);
          EXPECT_LE(std::abs(mean.gradient.z - middle.gradient.z), 2 * s);
          EXPECT_LE(std::abs(mean.value - middle.value), r);
        });
    }
  }
}

/// Smooth in one half, so that there are cubes of all sizes; with a solid point and a solid wall.
Medium<double> mediumWithSolids(
  const Dimensions& dimensions, Interpolation interpolation, double noise)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-noise, noise);
  SampledField<double> field(gridOf(dimensions),
    [&](double x, double, double)
    { return 1e-4 + (2 * x < static_cast<double>(dimensions[0]) ? 0 : any(random)); });
  std::vector<unsigned char> valid(field.samples.size(), 1);
  valid[valid.size() / 5] = 0;
  std::fill(
    valid.end() - dimensions[0] * dimensions[1], valid.end(), static_cast<unsigned char>(0));
  field.samples[valid.size() / 3] = std::numeric_limits<double>::quiet_NaN();
  field.field.valid = valid.data();
  field.field.ambient = 0;
  return buildMedium<double>(field.field, interpolation, 1);
}

TEST(HomogeneityMap, NoToleranceSkipsASolid)
{
  const Medium<double> medium = mediumWithSolids({ 30, 20, 10 }, Interpolation::Quadratic, 1e-5);
  const HomogeneityMap<double> map =
    buildHomogeneityMap(medium, Interpolation::Quadratic, anyTolerance, 1);
  for (const NuRange<double>& range : map.ranges)
  {
    EXPECT_FALSE(std::isnan(range.highest - range.lowest));
  }
  forPositions({ 30, 20, 10 }, { 0, 0, 0 }, 30,
    [&](const Vec3<double>& position)
    {
      if (isSolid(medium.view(), position))
      {
        EXPECT_EQ(homogeneousCube(map.view(), position).edge, 0);
      }
    });
}

TEST(HomogeneityMap, NothingIsWithinANegativeOrMissingTolerance)
{
  const Medium<double> medium = mediumOf<double>(
    { 9, 9, 9 }, Interpolation::Quadratic, [](double, double, double) { return 0; });
  for (const double tolerance : { -1., std::numeric_limits<double>::quiet_NaN() })
  {
    const auto map = buildHomogeneityMap(medium, Interpolation::Quadratic, tolerance, 1);
    EXPECT_EQ(homogeneousCube<double>(map.view(), { 4, 4, 4 }).edge, 0);
  }
}

} // namespace

} // namespace schlieren
