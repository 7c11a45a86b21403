// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Tree/BlockedLight.h"

#include "Medium/Tree/StraightRays.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace schlieren
{

namespace
{

constexpr double pixelsOfSpacing = 2;
constexpr double fewestPoints = 48, mostPoints = 1024; // along each axis

/// Faces between two boxes are in both, whatever rounding does; index coordinates, by their size.
constexpr double rounding = 1e-9;

bool meets(const StraightRay& ray, const Box& box)
{
  double entry = ray.entry, exit = ray.exit;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double margin = rounding * (box.high[axis] - box.low[axis]);
    const double low = box.low[axis] - margin - ray.start[axis];
    const double high = box.high[axis] + margin - ray.start[axis];
    if (ray.direction[axis] == 0)
    {
      exit = low <= 0 && high >= 0 ? exit : -std::numeric_limits<double>::infinity();
      continue;
    }
    const double a = low / ray.direction[axis], b = high / ray.direction[axis];
    entry = std::max(entry, std::min(a, b));
    exit = std::min(exit, std::max(a, b));
  }
  return entry < exit;
}

} // namespace

BlockedLight::BlockedLight(const Grid& grid, const Column& column)
  : grid_(grid)
  , column_(column)
{
  const Vec3<double> w = cross(column.u, column.v);
  const double along[3] = { w.x, w.y, w.z };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    depth_ +=
      std::abs(along[axis]) * grid.spacing[axis] * static_cast<double>(grid.dimensions[axis] - 1);
  }
  for (int side = 0; side < 2; ++side)
  {
    const ImageRange ofBox = rangeOfBox(grid, column, side);
    const double half = Column::widening * column.halfWidth[side];
    const double low = std::max(ofBox.low, column.middle[side] - half);
    const double high = std::min(ofBox.high, column.middle[side] + half);
    if (!(low < high) || !std::isfinite(high - low))
    {
      points_ = { 0, 0 };
      return;
    }
    const auto at = static_cast<std::size_t>(side);
    const double pixels = (high - low) / column.finest;
    points_[at] = static_cast<int>(std::clamp(pixels / pixelsOfSpacing, fewestPoints, mostPoints));
    spacing_[at] = (high - low) / points_[at];
    first_[at] = low + 0.5 * spacing_[at];
  }
  isBlocked_.resize(static_cast<std::size_t>(points_[0]) * static_cast<std::size_t>(points_[1]), 0);
}

BlockedLight::Places BlockedLight::placesOf(const Box& box) const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Places places{ { infinity, infinity }, { -infinity, -infinity }, infinity };
  const Vec3<double> w = cross(column_.u, column_.v);
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    double x[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double index = ((corner >> axis) & 1u) != 0 ? box.high[axis] : box.low[axis];
      x[axis] = grid_.origin[axis] + index * grid_.spacing[axis];
    }
    const Vec3<double> at{ x[0], x[1], x[2] };
    const double width = column_.widthAt(dot(at, w));
    places.narrowest = std::min(places.narrowest, width);
    for (int side = 0; side < 2; ++side)
    {
      const auto axis = static_cast<std::size_t>(side);
      const double coordinate =
        imageCoordinate(column_, side, dot(at, side == 0 ? column_.u : column_.v), width);
      const double point = (coordinate - first_[axis]) / spacing_[axis];
      places.low[axis] = std::min(places.low[axis], point);
      places.high[axis] = std::max(places.high[axis], point);
    }
  }
  return places;
}

void BlockedLight::add(const Box& box)
{
  if (isBlocked_.empty())
  {
    return;
  }
  const Places places = placesOf(box);
  if (!(places.narrowest > 0))
  {
    return;
  }
  const auto within = [&](double point, std::size_t axis)
  { return static_cast<int>(std::clamp(point, 0., static_cast<double>(points_[axis] - 1))); };
  for (int j = within(std::ceil(places.low[1]), 1); j <= within(std::floor(places.high[1]), 1); ++j)
  {
    for (int i = within(std::ceil(places.low[0]), 0); i <= within(std::floor(places.high[0]), 0);
         ++i)
    {
      unsigned char& isBlocked =
        isBlocked_[static_cast<std::size_t>(j) * static_cast<std::size_t>(points_[0]) +
          static_cast<std::size_t>(i)];
      if (isBlocked == 0 &&
        meets(rayAt(grid_, column_, first_[0] + i * spacing_[0], first_[1] + j * spacing_[1]), box))
      {
        isBlocked = 1;
      }
    }
  }
}

void BlockedLight::finish()
{
  if (isBlocked_.empty())
  {
    return;
  }
  const auto columns = static_cast<std::size_t>(points_[0]), stride = columns + 1;
  const auto rows = static_cast<std::size_t>(points_[1]);
  unblocked_.assign(stride * (rows + 1), 0);
  for (std::size_t j = 0; j < rows; ++j)
  {
    std::int32_t ofRow = 0;
    for (std::size_t i = 0; i < columns; ++i)
    {
      ofRow += isBlocked_[j * columns + i] == 0 ? 1 : 0;
      unblocked_[(j + 1) * stride + i + 1] = unblocked_[j * stride + i + 1] + ofRow;
    }
  }
}

bool BlockedLight::isDark(const Box& box, double slope) const
{
  if (unblocked_.empty())
  {
    return false;
  }
  const Places places = placesOf(box);
  if (!(places.narrowest > 0))
  {
    return false;
  }
  std::array<std::size_t, 2> from{}, to{};
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double margin = 1 + slope * depth_ / (places.narrowest * spacing_[axis]);
    const auto last = static_cast<double>(points_[axis]);
    from[axis] =
      static_cast<std::size_t>(std::clamp(std::floor(places.low[axis] - margin), 0., last));
    to[axis] =
      static_cast<std::size_t>(std::clamp(std::ceil(places.high[axis] + margin) + 1, 0., last));
  }
  if (from[0] >= to[0] || from[1] >= to[1])
  {
    return false;
  }
  const std::size_t stride = static_cast<std::size_t>(points_[0]) + 1;
  const auto before = [&](std::size_t column, std::size_t row)
  { return unblocked_[row * stride + column]; };
  return before(to[0], to[1]) - before(from[0], to[1]) - before(to[0], from[1]) +
    before(from[0], from[1]) ==
    0;
}

} // namespace schlieren
