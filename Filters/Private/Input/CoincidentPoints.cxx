// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/CoincidentPoints.h"

#include "Common/ParallelSort.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

namespace filters
{

double relativeRounding(const std::vector<Point>& points)
{
  for (const Point& point : points)
  {
    for (const double x : point)
    {
      if (static_cast<double>(static_cast<float>(x)) != x)
      {
        return 1e-12;
      }
    }
  }
  return 5e-7;
}

std::vector<double> mergingTolerances(
  const std::vector<Point>& points, const std::vector<double>& sizes, double rounding)
{
  constexpr double part = 1e-3;
  std::vector<double> tolerances(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double rounded = rounding * norm(points[i]);
    tolerances[i] = std::isfinite(sizes[i]) ? std::max(part * sizes[i], rounded) : rounded;
  }
  return tolerances;
}

namespace
{

/// A point's coordinates along two directions, and its number.
struct Placed
{
  double along, across;
  std::int32_t number;

  bool operator<(const Placed& other) const { return this->along < other.along; }
};

/// Points, sorted, whose tolerances differ by less than a factor of 2.
struct Class
{
  double most = 0; // largest tolerance
  std::vector<Placed> points;
};

/// Separates points with large tolerances, which would be compared with all points of fine regions.
std::vector<Class> classesOf(
  const std::vector<Point>& points, const std::vector<double>& tolerances)
{
  // Takes directions in which points of plausible meshes do not share coordinates.
  const Point along = unit({ 1, 0.6180339887, 0.2360679775 });
  const Point across = unit({ -0.4142135624, 1, 0.7320508076 });
  std::map<int, Class> classes;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double tolerance = tolerances[i];
    Class& of = classes[tolerance > 0 ? std::ilogb(tolerance) : std::numeric_limits<int>::min()];
    of.most = std::max(of.most, tolerance);
    of.points.push_back(
      { dot(along, points[i]), dot(across, points[i]), static_cast<std::int32_t>(i) });
  }
  std::vector<Class> result;
  for (auto& one : classes)
  {
    sortInParallel(one.second.points);
    result.push_back(std::move(one.second));
  }
  return result;
}

} // namespace

std::vector<std::int32_t> coincidentPoints(
  const std::vector<Point>& points, const std::vector<double>& tolerances)
{
  const std::vector<Class> classes = classesOf(points, tolerances);
  Classes ofPoints(points.size());
  const auto compare = [&](const Placed& one, const Placed& other)
  {
    const auto i = static_cast<std::size_t>(one.number), j = static_cast<std::size_t>(other.number);
    if (norm(points[i] - points[j]) <= std::min(tolerances[i], tolerances[j]))
    {
      ofPoints.join(i, j);
    }
  };
  for (auto fine = classes.begin(); fine != classes.end(); ++fine)
  {
    for (auto coarse = fine; coarse != classes.end(); ++coarse)
    {
      auto first = coarse->points.begin();
      const auto end = coarse->points.end();
      for (auto one = fine->points.begin(); one != fine->points.end(); ++one)
      {
        while (first != end && first->along < one->along - fine->most)
        {
          ++first;
        }
        for (auto other = fine == coarse ? one + 1 : first;
             other != end && other->along <= one->along + fine->most; ++other)
        {
          if (std::abs(other->across - one->across) <= fine->most)
          {
            compare(*one, *other);
          }
        }
      }
    }
  }
  std::vector<std::int32_t> numbers(points.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    numbers[i] = static_cast<std::int32_t>(ofPoints.rootOf(i));
  }
  return numbers;
}

} // namespace filters
