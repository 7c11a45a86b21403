// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BodyVoxels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

using Index = std::array<int, 3>;

/// The reach of a voxel from its centre along a direction (times the direction's length).
double reach(const Point& direction)
{
  return 0.5 * (std::abs(direction[0]) + std::abs(direction[1]) + std::abs(direction[2]));
}

/// The smallest integer that is not below x, within [low, high + 1].
int firstFrom(double x, int low, int high)
{
  return static_cast<int>(
    std::clamp(std::ceil(x), static_cast<double>(low), static_cast<double>(high) + 1));
}

/// The largest integer that is not above x, within [low - 1, high].
int lastTo(double x, int low, int high)
{
  return static_cast<int>(
    std::clamp(std::floor(x), static_cast<double>(low) - 1, static_cast<double>(high)));
}

/// One bit for each point of a box of the grid.
class Bits
{
public:
  Bits(const Index& first, const Index& last)
    : low(first)
    , high(last)
    , Flags(static_cast<std::size_t>(last[0] - first[0] + 1) *
        static_cast<std::size_t>(last[1] - first[1] + 1) *
        static_cast<std::size_t>(last[2] - first[2] + 1))
  {
  }

  bool at(int i, int j, int k) const { return holds({ i, j, k }) && this->Flags[place(i, j, k)]; }
  void set(int i, int j, int k) { this->Flags[place(i, j, k)] = true; }

  const Index low, high; // both are in

private:
  bool holds(const Index& at) const
  {
    return at[0] >= low[0] && at[0] <= high[0] && at[1] >= low[1] && at[1] <= high[1] &&
      at[2] >= low[2] && at[2] <= high[2];
  }
  std::size_t place(int i, int j, int k) const
  {
    const auto width = static_cast<std::size_t>(high[0] - low[0] + 1);
    const auto height = static_cast<std::size_t>(high[1] - low[1] + 1);
    return (static_cast<std::size_t>(k - low[2]) * height + static_cast<std::size_t>(j - low[1])) *
      width +
      static_cast<std::size_t>(i - low[0]);
  }

  std::vector<bool> Flags;
};

struct Corners
{
  Point a, b, c;

  Corners(const Triangles& surface, std::size_t triangle)
    : a(surface.corner(triangle, 0))
    , b(surface.corner(triangle, 1))
    , c(surface.corner(triangle, 2))
  {
  }
  double lowest(std::size_t axis) const { return std::min({ a[axis], b[axis], c[axis] }); }
  double highest(std::size_t axis) const { return std::max({ a[axis], b[axis], c[axis] }); }
};

/// The points of a box that closed surfaces hold.
Bits pointsInside(const BodySurfaces& bodies, const Index& low, const Index& high)
{
  constexpr int planesAtOnce = 8;
  Bits inside(low, high);
  std::vector<unsigned char> isInside;
  for (int first = low[2]; first <= high[2]; first += planesAtOnce)
  {
    const int end = std::min(first + planesAtOnce, high[2] + 1);
    bodies.findInside(
      { { static_cast<double>(low[0]), static_cast<double>(low[1]), static_cast<double>(first) },
        { 1, 1, 1 }, { high[0] - low[0] + 1, high[1] - low[1] + 1, end - first } },
      isInside);
    auto next = isInside.begin();
    for (int k = first; k < end; ++k)
    {
      for (int j = low[1]; j <= high[1]; ++j)
      {
        for (int i = low[0]; i <= high[0]; ++i)
        {
          if (*next++ != 0)
          {
            inside.set(i, j, k);
          }
        }
      }
    }
  }
  return inside;
}

/// Calls visit(i, j, k) for the points of the box whose voxels a triangle may meet: those that its plane and
/// its own box meet.
template <class Visit>
void forVoxelsNear(const Corners& t, const Index& low, const Index& high, const Visit& visit)
{
  const Point normal = cross(t.b - t.a, t.c - t.a);
  const auto size = [&](std::size_t axis) { return std::abs(normal[axis]); };
  std::size_t along = size(1) > size(0) ? 1 : 0; // where the plane is flattest
  along = size(2) > size(along) ? 2 : along;
  if (!(size(along) > 0))
  {
    return; // a line: the triangles beside it are there, too
  }
  const std::size_t u = (along + 1) % 3, v = (along + 2) % 3;
  const auto first = [&](std::size_t axis)
  { return firstFrom(t.lowest(axis) - 0.5, low[axis], high[axis]); };
  const auto last = [&](std::size_t axis)
  { return lastTo(t.highest(axis) + 0.5, low[axis], high[axis]); };
  const double depth = reach(normal) / size(along);
  Index at;
  for (at[u] = first(u); at[u] <= last(u); ++at[u])
  {
    for (at[v] = first(v); at[v] <= last(v); ++at[v])
    {
      const double plane =
        t.a[along] - (normal[u] * (at[u] - t.a[u]) + normal[v] * (at[v] - t.a[v])) / normal[along];
      const int end = std::min(last(along), lastTo(plane + depth, low[along], high[along]));
      for (at[along] = std::max(first(along), firstFrom(plane - depth, low[along], high[along]));
           at[along] <= end; ++at[along])
      {
        visit(at[0], at[1], at[2]);
      }
    }
  }
}

/// Whether a triangle crosses the segment from a point, from the fraction `earliest` of it on.
bool isAcross(
  const Corners& t, const Point& normal, const Point& from, const Point& segment, double earliest)
{
  constexpr double slack = 1e-9; // so that no way slips through between two triangles
  const double rate = dot(normal, segment);
  const double fraction = dot(normal, t.a - from) / rate;
  if (!(fraction >= earliest && fraction <= 1 + slack)) // NaN, too
  {
    return false;
  }
  const Point at{ from[0] + fraction * segment[0], from[1] + fraction * segment[1],
    from[2] + fraction * segment[2] };
  const double least = -slack * dot(normal, normal);
  return dot(cross(t.b - t.a, at - t.a), normal) >= least &&
    dot(cross(t.c - t.b, at - t.b), normal) >= least &&
    dot(cross(t.a - t.c, at - t.c), normal) >= least;
}

/// Whether a triangle crosses the segment from a grid point to one of its 26 neighbours that is not
/// inside, in the half of the segment that is nearer to the point.
bool isBetween(const Corners& t, const Bits& inside, const Index& at, double earliest)
{
  const Point normal = cross(t.b - t.a, t.c - t.a);
  const Point from{ static_cast<double>(at[0]), static_cast<double>(at[1]),
    static_cast<double>(at[2]) };
  for (int neighbour = 0; neighbour < 27; ++neighbour)
  {
    const int i = neighbour % 3 - 1, j = neighbour / 3 % 3 - 1, k = neighbour / 9 - 1;
    if (!inside.at(at[0] + i, at[1] + j, at[2] + k) &&
      isAcross(t, normal, from, { 0.5 * i, 0.5 * j, 0.5 * k }, earliest))
    {
      return true;
    }
  }
  return false;
}

/// The box of the grid, and of a layer of points around it, that a surface can concern. Empty, with
/// low > high, where there is none.
std::pair<Index, Index> boxAround(const Triangles& surface, const Index& dimensions)
{
  constexpr int more = 1;
  std::pair<Index, Index> box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t triangle = 0; triangle < surface.size(); ++triangle)
    {
      const Corners t(surface, triangle);
      low = std::min(low, t.lowest(axis));
      high = std::max(high, t.highest(axis));
    }
    box.first[axis] = firstFrom(low - 0.5, -more, dimensions[axis] - 1 + more);
    box.second[axis] = lastTo(high + 0.5, -more, dimensions[axis] - 1 + more);
  }
  return box;
}

} // namespace

void voxelize(const BodySurfaces& bodies, const std::array<int, 3>& dimensions,
  const std::function<void(int, int, int)>& mark)
{
  const Triangles& surface = bodies.surface();
  const auto [low, high] = boxAround(surface, dimensions);
  if (low[0] > high[0] || low[1] > high[1] || low[2] > high[2])
  {
    return;
  }
  const Bits inside = pointsInside(bodies, low, high);
  for (int k = std::max(low[2], 0); k <= std::min(high[2], dimensions[2] - 1); ++k)
  {
    for (int j = std::max(low[1], 0); j <= std::min(high[1], dimensions[1] - 1); ++j)
    {
      for (int i = std::max(low[0], 0); i <= std::min(high[0], dimensions[0] - 1); ++i)
      {
        if (inside.at(i, j, k))
        {
          mark(i, j, k);
        }
      }
    }
  }
  for (std::size_t triangle = 0; triangle < surface.size(); ++triangle)
  {
    // A point on the wall of a body is no reason to call that thin.
    const double earliest = bodies.isOfClosed(static_cast<std::int32_t>(triangle)) ? 1e-6 : 0;
    const Corners t(surface, triangle);
    forVoxelsNear(t, low, high,
      [&](int i, int j, int k)
      {
        const bool isInGrid =
          i >= 0 && i < dimensions[0] && j >= 0 && j < dimensions[1] && k >= 0 && k < dimensions[2];
        if (isInGrid && !inside.at(i, j, k) && isBetween(t, inside, { i, j, k }, earliest))
        {
          mark(i, j, k);
        }
      });
  }
}

} // namespace filters
