// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Tree/StraightRays.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace schlieren
{

StraightRay rayAt(const Grid& grid, const Column& column, double u, double v)
{
  Vec3<double> w = cross(column.u, column.v);
  Vec3<double> start = u * column.u + v * column.v;
  StraightRay ray{ {}, {}, -std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity() };
  if (column.pupil > 0)
  {
    start = start + column.plane * w;
    const Vec3<double> toPupil =
      column.pupil * w + (column.middle[0] - u) * column.u + (column.middle[1] - v) * column.v;
    ray.exit = length(toPupil);
    w = (1 / ray.exit) * toPupil;
  }
  const double from[3] = { start.x, start.y, start.z };
  const double along[3] = { w.x, w.y, w.z };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ray.start[axis] = (from[axis] - grid.origin[axis]) / grid.spacing[axis];
    ray.direction[axis] = along[axis] / grid.spacing[axis];
    const double last = static_cast<double>(grid.dimensions[axis] - 1);
    if (ray.direction[axis] != 0)
    {
      const double a = -ray.start[axis] / ray.direction[axis];
      const double b = (last - ray.start[axis]) / ray.direction[axis];
      ray.entry = std::max(ray.entry, std::min(a, b));
      ray.exit = std::min(ray.exit, std::max(a, b));
    }
    else if (!(ray.start[axis] >= 0 && ray.start[axis] <= last))
    {
      ray.exit = ray.entry;
    }
  }
  return ray;
}

double imageCoordinate(const Column& column, int side, double coordinate, double width)
{
  return column.pupil > 0 ? column.middle[side] + (coordinate - column.middle[side]) / width
                          : coordinate;
}

ImageRange rangeOfBox(const Grid& grid, const Column& column, int side)
{
  const Vec3<double>& along = side == 0 ? column.u : column.v;
  if (!(column.pupil > 0))
  {
    const double a[3] = { along.x, along.y, along.z };
    double middle = 0, half = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double halfEdge =
        0.5 * grid.spacing[axis] * static_cast<double>(grid.dimensions[axis] - 1);
      middle += a[axis] * (grid.origin[axis] + halfEdge);
      half += std::abs(a[axis]) * halfEdge;
    }
    return { middle - half, middle + half };
  }
  const Vec3<double> w = cross(column.u, column.v);
  ImageRange range{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  for (int corner = 0; corner < 8; ++corner)
  {
    double x[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const bool isHigh = ((corner >> axis) & 1) != 0;
      x[axis] = grid.origin[axis] +
        (isHigh ? grid.spacing[axis] * static_cast<double>(grid.dimensions[axis] - 1) : 0);
    }
    const Vec3<double> at{ x[0], x[1], x[2] };
    const double width = column.widthAt(dot(at, w));
    if (!(width > 0))
    {
      // What is beside the pupil may be seen anywhere.
      return { -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity() };
    }
    const double place = imageCoordinate(column, side, dot(at, along), width);
    range.low = std::min(range.low, place);
    range.high = std::max(range.high, place);
  }
  return range;
}

Products productsWith(const Vec3<double>& vector, const Box& box)
{
  const double a[3] = { vector.x, vector.y, vector.z };
  Products products{ 0, 0 };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    products.middle += a[axis] * 0.5 * (box.low[axis] + box.high[axis]);
    products.half += std::abs(a[axis]) * 0.5 * (box.high[axis] - box.low[axis]);
  }
  return products;
}

namespace
{

bool isSeenAlong(
  const Column& column, const Vec3<double>& direction, double middle, double widest, const Box& box)
{
  if (!(column.pupil > 0))
  {
    const Products products = productsWith(direction, box);
    return !(std::abs(products.middle - middle) > widest + products.half);
  }
  if (!std::isfinite(widest))
  {
    return true;
  }
  // x . u - middle <= widest (1 - (x . w - plane) / pupil), and the same on the other side.
  const Vec3<double> narrowing = (widest / column.pupil) * cross(column.u, column.v);
  const double limit = widest * (1 + column.plane / column.pupil);
  for (const double sign : { -1., 1. })
  {
    const Products products = productsWith(sign * direction + narrowing, box);
    if (products.middle - products.half > sign * middle + limit)
    {
      return false;
    }
  }
  return true;
}

} // namespace

bool isSeenIn(const Column& column, const Column::Part& part, const Box& box)
{
  return isSeenAlong(column, column.u, part.middle[0], part.halfWidth[0], box) &&
    isSeenAlong(column, column.v, part.middle[1], part.halfWidth[1], box);
}

} // namespace schlieren
