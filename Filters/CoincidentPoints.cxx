// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "CoincidentPoints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
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

std::vector<std::int32_t> coincidentPoints(
  const std::vector<Point>& points, const std::vector<double>& tolerances)
{
  // Sorted along a direction across which the points of no plausible mesh lie in planes, so that few others are
  // in between.
  const Point along = unit({ 1, 0.6180339887, 0.2360679775 });
  std::vector<std::pair<double, std::int32_t>> sorted;
  sorted.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    sorted.emplace_back(dot(along, points[i]), static_cast<std::int32_t>(i));
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::int32_t> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  const auto rootOf = [&](std::int32_t i)
  {
    while (numbers[static_cast<std::size_t>(i)] != i)
    {
      i = numbers[static_cast<std::size_t>(i)];
    }
    return i;
  };
  for (auto one = sorted.begin(); one != sorted.end(); ++one)
  {
    const auto i = static_cast<std::size_t>(one->second);
    for (auto other = one + 1; other != sorted.end() && other->first - one->first <= tolerances[i];
         ++other)
    {
      const auto j = static_cast<std::size_t>(other->second);
      if (norm(points[i] - points[j]) <= std::min(tolerances[i], tolerances[j]))
      {
        const auto [low, high] = std::minmax({ rootOf(one->second), rootOf(other->second) });
        numbers[static_cast<std::size_t>(high)] = low;
      }
    }
  }
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    numbers[i] = rootOf(static_cast<std::int32_t>(i));
  }
  return numbers;
}

} // namespace filters
