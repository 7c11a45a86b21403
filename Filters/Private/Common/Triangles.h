// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Vectors.h"

#include "Schlieren.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace filters
{

/// A surface of triangles. Points that triangles use are finite.
struct Triangles
{
  using Corners = std::array<std::int32_t, 3>;

  std::vector<Point> points;
  std::vector<Corners> corners;

  std::size_t size() const { return this->corners.size(); }
  const Point& corner(std::size_t triangle, std::size_t i) const
  {
    return this->points[static_cast<std::size_t>(this->corners[triangle][i])];
  }
  /// Returns the normal, whose length is twice the area.
  Point normal(std::size_t triangle) const
  {
    const Point& a = this->corner(triangle, 0);
    return cross(this->corner(triangle, 1) - a, this->corner(triangle, 2) - a);
  }
};

/// A triangle at an edge, given by its points in order of their numbers.
struct EdgeOfTriangle
{
  std::int32_t low, high;
  std::int32_t triangle;

  bool isSameEdge(const EdgeOfTriangle& other) const
  {
    return this->low == other.low && this->high == other.high;
  }
};
std::vector<EdgeOfTriangle> edgesOf(const Triangles& surface);

/// A hierarchy of bounding boxes. VTK's locators cannot measure distances in voxels, which differ
/// by axis, and return cells as objects, too slowly for thousands of queries per brick.
class TriangleTree
{
public:
  /// Keeps a reference to the triangles.
  explicit TriangleTree(const Triangles& triangles);

  /// Calls visit(triangle) for triangles whose bounds meet a box.
  template <class Visit>
  void forTrianglesAt(const schlieren::Box& box, const Visit& visit) const;

  /// Finds the triangle nearest to a point. Of equally near ones, such as at a common edge, chooses
  /// the one whose plane is most distant, which faces the point most. -1: there are none.
  int nearest(const Point& place) const;

private:
  struct Node
  {
    Point low, high;
    std::int32_t
      first; // in Order; inner nodes: the second child, the first one being the next node
    std::int32_t count; // 0: an inner node
  };
  static constexpr std::int32_t maxInLeaf = 4;

  void build(std::int32_t begin, std::int32_t end, const std::vector<Point>& centres);
  void around(std::int32_t triangle, Node& node) const;
  static bool meets(const Point& low, const Point& high, const schlieren::Box& box)
  {
    return low[0] <= box.high[0] && high[0] >= box.low[0] && low[1] <= box.high[1] &&
      high[1] >= box.low[1] && low[2] <= box.high[2] && high[2] >= box.low[2];
  }

  const Triangles& Surface;
  std::vector<Node> Nodes;
  std::vector<std::int32_t> Order;
};

double squaredDistance(const Triangles& surface, std::size_t triangle, const Point& place);

/// Sorts triangles and points, independently of ranks, and removes duplicate triangles. `marks`: of the triangles.
void sortTriangles(Triangles& surface, std::vector<unsigned char>& marks);

/// Returns whether a triangle meets a box (separating axes; Akenine-Moeller 2001).
bool meets(const Triangles& surface, std::size_t triangle, const schlieren::Box& box);

template <class Visit>
void TriangleTree::forTrianglesAt(const schlieren::Box& box, const Visit& visit) const
{
  std::int32_t stack[64];
  int waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0 && !this->Nodes.empty())
  {
    const std::int32_t number = stack[--waiting];
    const Node& node = this->Nodes[static_cast<std::size_t>(number)];
    if (!meets(node.low, node.high, box))
    {
      continue;
    }
    if (node.count == 0)
    {
      stack[waiting++] = node.first;
      stack[waiting++] = number + 1;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i)
    {
      const std::int32_t triangle = this->Order[static_cast<std::size_t>(i)];
      Node own;
      this->around(triangle, own);
      if (meets(own.low, own.high, box))
      {
        visit(triangle);
      }
    }
  }
}

} // namespace filters
