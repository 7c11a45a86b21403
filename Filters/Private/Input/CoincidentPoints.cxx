// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/CoincidentPoints.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

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

namespace
{

/// A point's coordinates along two directions, and its number.
struct Placed
{
  double along, across;
  std::int32_t number;

  bool operator<(const Placed& other) const
  {
    return this->along < other.along || (this->along == other.along && this->number < other.number);
  }
};

/// Points, sorted, whose tolerances differ by less than a factor of 2. Points with large ones would
/// be compared with all points of fine regions.
struct Class
{
  double most = 0; // largest tolerance
  std::vector<Placed> points;
};

/// Returns the distances within which points coincide.
std::vector<double> tolerancesOf(const std::vector<Point>& points, const std::vector<double>& sizes)
{
  constexpr double part = 1e-3;
  const double rounding = relativeRounding(points);
  std::vector<double> tolerances(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double size = std::isfinite(sizes[i]) ? sizes[i] : 0;
    tolerances[i] = std::max(part * size, rounding * norm(points[i]));
  }
  return tolerances;
}

/// Sorts the points along a direction in which those of plausible meshes share no coordinates.
std::vector<Placed> sorted(const std::vector<Point>& points)
{
  const Point along = unit({ 1, 0.6180339887, 0.2360679775 });
  const Point across = unit({ -0.4142135624, 1, 0.7320508076 });
  std::vector<Placed> placed(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    placed[i] = { dot(along, points[i]), dot(across, points[i]), static_cast<std::int32_t>(i) };
  }
  vtkSMPTools::Sort(placed.begin(), placed.end());
  return placed;
}

} // namespace

std::vector<std::int32_t> coincidentPoints(
  const std::vector<Point>& points, const std::vector<double>& sizes)
{
  const auto at = [](std::int32_t number) { return static_cast<std::size_t>(number); };
  std::vector<double> tolerances = tolerancesOf(points, sizes);
  Classes ofPoints(points.size());
  // Only one of equal points, the first, is compared with others.
  std::map<int, Class> classes;
  std::vector<Placed> all = sorted(points);
  for (std::size_t next = 0; next < all.size();)
  {
    const Placed first = all[next];
    double& tolerance = tolerances[at(first.number)];
    for (++next; next < all.size() && points[at(all[next].number)] == points[at(first.number)];
         ++next)
    {
      ofPoints.join(at(first.number), at(all[next].number));
      tolerance = std::min(tolerance, tolerances[at(all[next].number)]);
    }
    Class& of = classes[tolerance > 0 ? std::ilogb(tolerance) : std::numeric_limits<int>::min()];
    of.most = std::max(of.most, tolerance);
    of.points.push_back(first);
  }
  all = {};
  for (auto fine = classes.begin(); fine != classes.end(); ++fine)
  {
    const double reach = fine->second.most;
    for (auto coarse = fine; coarse != classes.end(); ++coarse)
    {
      auto first = coarse->second.points.begin();
      const auto end = coarse->second.points.end();
      for (auto one = fine->second.points.begin(); one != fine->second.points.end(); ++one)
      {
        while (first != end && first->along < one->along - reach)
        {
          ++first;
        }
        for (auto other = fine == coarse ? one + 1 : first;
             other != end && other->along <= one->along + reach; ++other)
        {
          const std::size_t i = at(one->number), j = at(other->number);
          if (std::abs(other->across - one->across) <= reach &&
            norm(points[i] - points[j]) <= std::min(tolerances[i], tolerances[j]))
          {
            ofPoints.join(i, j);
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
