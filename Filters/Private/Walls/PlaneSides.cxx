// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/PlaneSides.h"

#include "Input/CoincidentPoints.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace filters
{

namespace
{

constexpr double inPlane = 1e-5; // of the size
constexpr double sineOfFlat = 1e-4;
constexpr double leastOfLargest = 0.01; // area
constexpr std::size_t mostSides = 30;   // that are looked at
constexpr double acrossFirst = 0.1;     // cosine of the angle of the second axis
constexpr double rounded = 1e-11;       // 1 - cosine, and of areas
constexpr std::array<Point, 3> coordinateAxes{ Point{ 1, 0, 0 }, Point{ 0, 1, 0 },
  Point{ 0, 0, 1 } };

/// Returns the coordinate axis that a direction is least along.
const Point& leastAlong(const Point& direction)
{
  return *std::min_element(coordinateAxes.begin(), coordinateAxes.end(),
    [&](const Point& a, const Point& b)
    { return std::abs(dot(a, direction)) < std::abs(dot(b, direction)); });
}

} // namespace

PlaneSides::PlaneSides(const Triangles& surface)
  : Surface(surface)
  , Edges(edgesOf(surface))
  , Normals(surface.size())
  , Heights(surface.size())
{
  double farthest = 0, size = 0;
  for (const Point& point : surface.points)
  {
    farthest = std::max(farthest, norm(point));
  }
  for (const Point& axis : coordinateAxes)
  {
    const auto [low, high] = this->rangeAlong(axis);
    size = std::max(size, high - low);
  }
  this->Rounding = relativeRounding(surface.points) * farthest;
  this->Tolerance = std::max(inPlane * size, 4 * this->Rounding);
  for (std::size_t t = 0; t < surface.size(); ++t)
  {
    const Point normal = surface.normal(t);
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      longest = std::max(longest, norm(surface.corner(t, i) - surface.corner(t, (i + 1) % 3)));
    }
    this->Normals[t] = unit(normal);
    this->Heights[t] = longest > 0 ? norm(normal) / longest : 0;
  }
}

std::array<double, 2> PlaneSides::rangeAlong(const Point& direction) const
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Point& point : this->Surface.points)
  {
    const double at = dot(direction, point);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return { low, high };
}

PlaneSide PlaneSides::at(const Point& normal) const
{
  PlaneSide side{ normal, this->rangeAlong(normal)[1], 0, 0 };
  const auto& points = this->Surface.points;
  std::vector<unsigned char> areIn(points.size()), areGentle(points.size(), 0);
  std::transform(points.begin(), points.end(), areIn.begin(),
    [&](const Point& point) { return side.offset - dot(normal, point) < this->Tolerance ? 1 : 0; });
  const auto hasAll = [&](std::size_t t, const std::vector<unsigned char>& flags)
  {
    const Triangles::Corners& corners = this->Surface.corners[t];
    return std::all_of(corners.begin(), corners.end(),
      [&](std::int32_t corner) { return flags[static_cast<std::size_t>(corner)] != 0; });
  };
  std::vector<std::size_t> flat;
  for (std::size_t t = 0; t < this->Surface.size(); ++t)
  {
    if (hasAll(t, areIn))
    {
      flat.push_back(t);
    }
    else if (std::abs(dot(this->Normals[t], normal)) > cosineOfGentle)
    {
      for (const std::int32_t corner : this->Surface.corners[t])
      {
        areGentle[static_cast<std::size_t>(corner)] = 1;
      }
    }
  }
  for (const std::size_t t : flat)
  {
    const Triangles::Corners& corners = this->Surface.corners[t];
    const bool endsSharply = std::none_of(corners.begin(), corners.end(),
      [&](std::int32_t corner) { return areGentle[static_cast<std::size_t>(corner)] != 0; });
    side.area += endsSharply ? 0.5 * norm(this->Surface.normal(t)) : 0;
  }
  if (side.area > 0)
  {
    const Point along = unit(cross(normal, leastAlong(normal)));
    const auto [low, high] = this->rangeAlong(along);
    const auto [left, right] = this->rangeAlong(cross(normal, along));
    side.part = side.area / ((high - low) * (right - left));
  }
  return side;
}

bool PlaneSides::areInOnePlane(std::size_t one, std::size_t other) const
{
  const double height = std::min(this->Heights[one], this->Heights[other]);
  return dot(this->Normals[one], this->Normals[other]) > 0 &&
    norm(cross(this->Normals[one], this->Normals[other])) * height <
    sineOfFlat * height + 8 * this->Rounding;
}

std::vector<PlaneSide> PlaneSides::largest() const
{
  Classes patches(this->Surface.size());
  this->forNeighbours(
    [&](std::size_t one, std::size_t other)
    {
      if (this->areInOnePlane(one, other))
      {
        patches.join(one, other);
      }
    });
  // Sums of normals are known well, unlike those of thin triangles.
  std::vector<Point> normals(this->Surface.size(), Point{ 0, 0, 0 });
  for (std::size_t t = 0; t < this->Surface.size(); ++t)
  {
    Point& sum = normals[patches.rootOf(t)];
    sum = sum + this->Surface.normal(t);
  }
  const auto last =
    normals.begin() + static_cast<std::ptrdiff_t>(std::min(mostSides, normals.size()));
  std::partial_sort(normals.begin(), last, normals.end(),
    [](const Point& a, const Point& b)
    {
      const double ofA = dot(a, a), ofB = dot(b, b);
      return ofA > ofB || (ofA == ofB && a > b);
    });
  std::vector<PlaneSide> sides;
  for (auto sum = normals.begin(); sum != last; ++sum)
  {
    const Point normal = -1. * unit(*sum);
    const bool isKnown = std::any_of(sides.begin(), sides.end(),
      [&](const PlaneSide& side) { return norm(side.normal - normal) < sineOfFlat; });
    if (!isKnown && norm(*sum) > leastOfLargest * norm(normals[0]))
    {
      sides.push_back(this->at(normal));
    }
  }
  sides.erase(std::remove_if(
                sides.begin(), sides.end(), [](const PlaneSide& side) { return !(side.area > 0); }),
    sides.end());
  std::stable_sort(sides.begin(), sides.end(),
    [](const PlaneSide& a, const PlaneSide& b) { return a.area > b.area; });
  return sides;
}

bool isAlong(const Point& direction, const std::array<Point, 3>& axes)
{
  return std::any_of(axes.begin(), axes.end(),
    [&](const Point& axis) { return std::abs(dot(axis, direction)) > 1 - rounded; });
}

std::array<Point, 3> axesAlong(const std::vector<PlaneSide>& sides, bool isLayer)
{
  const auto areaAlong = [&](const std::array<Point, 3>& axes)
  {
    double area = 0;
    for (const PlaneSide& side : sides)
    {
      area += isAlong(side.normal, axes) ? side.area : 0;
    }
    return area;
  };
  std::array<Point, 3> best = coordinateAxes;
  for (const PlaneSide& side : sides)
  {
    const Point& first = side.normal;
    Point second = isLayer ? Point{ -first[1], first[0], 0 } : leastAlong(first);
    for (auto other = sides.rbegin(); other != sides.rend() && !isLayer; ++other)
    {
      second = std::abs(dot(other->normal, first)) < acrossFirst ? other->normal : second;
    }
    second = unit(second - dot(second, first) * first);
    const std::array<Point, 3> axes{ first, second, cross(first, second) };
    best = areaAlong(axes) > (1 + rounded) * areaAlong(best) ? axes : best;
  }
  return isAlong(best[0], coordinateAxes) && isAlong(best[1], coordinateAxes) ? coordinateAxes
                                                                              : best;
}

} // namespace filters
