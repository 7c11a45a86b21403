// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Triangles.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace filters
{

std::vector<EdgeOfTriangle> edgesOf(const Triangles& surface)
{
  std::vector<EdgeOfTriangle> edges;
  edges.reserve(3 * surface.size());
  for (std::size_t t = 0; t < surface.size(); ++t)
  {
    const Triangles::Corners& corners = surface.corners[t];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto [low, high] = std::minmax({ corners[i], corners[(i + 1) % 3] });
      edges.push_back({ low, high, static_cast<std::int32_t>(t) });
    }
  }
  std::sort(edges.begin(), edges.end(),
    [](const EdgeOfTriangle& a, const EdgeOfTriangle& b)
    { return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle); });
  return edges;
}

TriangleTree::TriangleTree(const Triangles& triangles)
  : Surface(triangles)
  , Order(triangles.size())
{
  if (triangles.size() == 0)
  {
    return;
  }
  std::iota(this->Order.begin(), this->Order.end(), 0);
  std::vector<Point> centres(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    centres[t] =
      (1. / 3) * (triangles.corner(t, 0) + triangles.corner(t, 1) + triangles.corner(t, 2));
  }
  this->Nodes.reserve(triangles.size());
  this->build(0, static_cast<std::int32_t>(triangles.size()), centres);
}

void TriangleTree::around(std::int32_t triangle, Node& node) const
{
  const auto t = static_cast<std::size_t>(triangle);
  const Point &a = this->Surface.corner(t, 0), &b = this->Surface.corner(t, 1),
              &c = this->Surface.corner(t, 2);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    node.low[axis] = std::min({ a[axis], b[axis], c[axis] });
    node.high[axis] = std::max({ a[axis], b[axis], c[axis] });
  }
}

void TriangleTree::build(std::int32_t begin, std::int32_t end, const std::vector<Point>& centres)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Node node{ { infinity, infinity, infinity }, { -infinity, -infinity, -infinity }, begin, 0 };
  Point low = node.low, high = node.high; // bounds of the centres
  for (std::int32_t i = begin; i < end; ++i)
  {
    const std::int32_t triangle = this->Order[static_cast<std::size_t>(i)];
    Node own;
    this->around(triangle, own);
    const Point& centre = centres[static_cast<std::size_t>(triangle)];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      node.low[axis] = std::min(node.low[axis], own.low[axis]);
      node.high[axis] = std::max(node.high[axis], own.high[axis]);
      low[axis] = std::min(low[axis], centre[axis]);
      high[axis] = std::max(high[axis], centre[axis]);
    }
  }
  const std::size_t number = this->Nodes.size();
  this->Nodes.push_back(node);
  if (end - begin <= maxInLeaf)
  {
    this->Nodes[number].count = end - begin;
    return;
  }
  const Point lengths = high - low;
  const auto axis =
    static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(this->Order.begin() + begin, this->Order.begin() + middle,
    this->Order.begin() + end,
    [&](std::int32_t a, std::int32_t b)
    {
      const double x = centres[static_cast<std::size_t>(a)][axis];
      const double y = centres[static_cast<std::size_t>(b)][axis];
      return x < y || (x == y && a < b); // ties by number keep the tree deterministic
    });
  this->build(begin, middle, centres);
  this->Nodes[number].first = static_cast<std::int32_t>(this->Nodes.size());
  this->build(middle, end, centres);
}

int TriangleTree::nearest(const Point& place) const
{
  // Ratio of squared distances that rounding explains.
  constexpr double tie = 1 + 1e-12;
  if (this->Nodes.empty())
  {
    return -1;
  }
  const auto squaredDistanceTo = [&](const Node& node)
  {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double outside =
        std::max({ node.low[axis] - place[axis], place[axis] - node.high[axis], 0. });
      sum += outside * outside;
    }
    return sum;
  };
  struct Waiting
  {
    std::int32_t node;
    double squared;
  } stack[64];
  int waiting = 0;
  double best = std::numeric_limits<double>::infinity(), height = 0;
  std::int32_t nearest = -1;
  stack[waiting++] = { 0, squaredDistanceTo(this->Nodes[0]) };
  while (waiting > 0)
  {
    const Waiting next = stack[--waiting];
    if (nearest >= 0 && next.squared > tie * best)
    {
      continue;
    }
    const Node& node = this->Nodes[static_cast<std::size_t>(next.node)];
    if (node.count == 0)
    {
      Waiting one{ next.node + 1, 0 }, other{ node.first, 0 };
      one.squared = squaredDistanceTo(this->Nodes[static_cast<std::size_t>(one.node)]);
      other.squared = squaredDistanceTo(this->Nodes[static_cast<std::size_t>(other.node)]);
      if (one.squared < other.squared)
      {
        std::swap(one, other);
      }
      stack[waiting++] = one;
      stack[waiting++] = other; // the nearer one first
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i)
    {
      const std::int32_t triangle = this->Order[static_cast<std::size_t>(i)];
      const double squared =
        squaredDistance(this->Surface, static_cast<std::size_t>(triangle), place);
      if (squared > tie * best)
      {
        continue;
      }
      const auto number = static_cast<std::size_t>(triangle);
      const double over =
        std::abs(dot(unit(this->Surface.normal(number)), place - this->Surface.corner(number, 0)));
      if (nearest < 0 || tie * squared < best || over > height)
      {
        nearest = triangle;
        height = over;
      }
      best = std::min(best, squared);
    }
  }
  return nearest;
}

double squaredDistance(const Triangles& surface, std::size_t triangle, const Point& place)
{
  const Point normal = surface.normal(triangle);
  const double size = dot(normal, normal);
  bool isInside = size > 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point& a = surface.corner(triangle, i);
    const Point edge = surface.corner(triangle, (i + 1) % 3) - a, from = place - a;
    isInside = isInside && dot(cross(edge, from), normal) >= 0;
    const double length = dot(edge, edge);
    const double fraction = length > 0 ? std::clamp(dot(from, edge) / length, 0., 1.) : 0;
    const Point miss = from - fraction * edge;
    least = std::min(least, dot(miss, miss));
  }
  if (isInside)
  {
    const double height = dot(place - surface.corner(triangle, 0), normal);
    return std::min(least, height * height / size);
  }
  return least;
}

bool meets(const Triangles& surface, std::size_t triangle, const schlieren::Box& box)
{
  const Point centre = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  const std::array<Point, 3> corners = { surface.corner(triangle, 0) - centre,
    surface.corner(triangle, 1) - centre, surface.corner(triangle, 2) - centre };
  const auto isApart = [&](const Point& axis)
  {
    const double a = dot(axis, corners[0]), b = dot(axis, corners[1]), c = dot(axis, corners[2]);
    const double reach =
      half[0] * std::abs(axis[0]) + half[1] * std::abs(axis[1]) + half[2] * std::abs(axis[2]);
    return std::min({ a, b, c }) > reach || std::max({ a, b, c }) < -reach;
  };
  const Point units[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point edge = corners[(i + 1) % 3] - corners[i];
    for (const Point& along : units)
    {
      if (isApart(cross(along, edge)))
      {
        return false;
      }
    }
    if (isApart(units[i]))
    {
      return false;
    }
  }
  return !isApart(surface.normal(triangle));
}

void sortTriangles(Triangles& surface, std::vector<unsigned char>& marks)
{
  std::vector<Point> points = surface.points;
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  struct Triangle
  {
    Triangles::Corners corners;
    unsigned char mark;
  };
  std::vector<Triangle> triangles;
  for (std::size_t triangle = 0; triangle < surface.size(); ++triangle)
  {
    Triangle& sorted = triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto at = std::lower_bound(points.begin(), points.end(), surface.corner(triangle, i));
      sorted.corners[i] = static_cast<std::int32_t>(at - points.begin());
    }
    sorted.mark = marks[triangle];
  }
  std::sort(triangles.begin(), triangles.end(),
    [](const Triangle& a, const Triangle& b) { return a.corners < b.corners; });
  triangles.erase(std::unique(triangles.begin(), triangles.end(),
                    [](const Triangle& a, const Triangle& b) { return a.corners == b.corners; }),
    triangles.end());
  surface.points = std::move(points);
  surface.corners.clear();
  marks.clear();
  for (const Triangle& triangle : triangles)
  {
    surface.corners.push_back(triangle.corners);
    marks.push_back(triangle.mark);
  }
}

} // namespace filters
