// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/OuterFaces.h"

#include "Input/CoincidentPoints.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace filters
{

namespace
{

constexpr double bulge = 0.1;           // tolerance of the hull, in heights of a triangle
constexpr double cosineOfSmooth = 0.82; // 35 degrees
constexpr double sineOfFlat = 5e-3;     // 0.3 degrees
constexpr int fewestOfFlat = 5;         // triangles; fewer are facets of a curved surface
constexpr double cosineOfFacing = 0.5;  // 60 degrees
constexpr double touchingPart = 1e-4;   // relative to a triangle's height

class Finder
{
public:
  Finder(const Triangles& surface, const TriangleTree& tree, double rounding, std::size_t axes)
    : Surface(surface)
    , Tree(tree)
    , Rounding(rounding)
    , Axes(axes)
    , Edges(edgesOf(surface))
    , Normals(surface.size())
    , Heights(surface.size())
    , IsOnHull(surface.size(), 0)
  {
    for (std::size_t t = 0; t < surface.size(); ++t)
    {
      const Point normal = surface.normal(t);
      this->Normals[t] = -1. * unit(normal); // outward
      double longest = 0;
      for (std::size_t i = 0; i < 3; ++i)
      {
        longest = std::max(longest, norm(surface.corner(t, i) - surface.corner(t, (i + 1) % 3)));
      }
      this->Heights[t] = longest > 0 ? norm(normal) / longest : 0;
    }
  }

  std::vector<unsigned char> find()
  {
    findHull();
    return joinOthers();
  }

private:
  double roundingAt(std::size_t t) const
  {
    return this->Rounding * norm(this->Surface.corner(t, 0));
  }

  /// Calls visit(one, other) for triangles at the same edge.
  template <class Visit>
  void forNeighbours(const Visit& visit) const
  {
    for (std::size_t i = 1; i < this->Edges.size(); ++i)
    {
      if (this->Edges[i].isSameEdge(this->Edges[i - 1]))
      {
        visit(static_cast<std::size_t>(this->Edges[i - 1].triangle),
          static_cast<std::size_t>(this->Edges[i].triangle));
      }
    }
  }

  bool areInOnePlane(std::size_t one, std::size_t other) const
  {
    const double noise = (roundingAt(one) + roundingAt(other)) /
      std::max(
        std::min(this->Heights[one], this->Heights[other]), std::numeric_limits<double>::min());
    return norm(cross(this->Normals[one], this->Normals[other])) < sineOfFlat + 4 * noise &&
      dot(this->Normals[one], this->Normals[other]) > 0;
  }

  void findHull()
  {
    // Extends the hull by triangles in the planes of its triangles, because sides of domains are
    // flat.
    std::vector<std::vector<std::int32_t>> neighbours(this->Surface.size());
    forNeighbours(
      [&](std::size_t one, std::size_t other)
      {
        neighbours[one].push_back(static_cast<std::int32_t>(other));
        neighbours[other].push_back(static_cast<std::int32_t>(one));
      });
    // Begins with large triangles, whose planes are least affected by rounding.
    std::vector<std::size_t> sorted(this->Surface.size());
    std::iota(sorted.begin(), sorted.end(), std::size_t{ 0 });
    std::stable_sort(sorted.begin(), sorted.end(),
      [&](std::size_t a, std::size_t b) { return this->Heights[a] > this->Heights[b]; });
    std::vector<unsigned char> isKnown(this->Surface.size(), 0);
    std::vector<std::size_t> waiting;
    for (const std::size_t first : sorted)
    {
      if (isKnown[first])
      {
        continue;
      }
      isKnown[first] = 1;
      const Point normal = this->Normals[first];
      const double offset = dot(normal, this->Surface.corner(first, 0));
      const double excess = bulge * this->Heights[first] + 4 * roundingAt(first);
      if (!(this->Heights[first] > 0) || this->Tree.hasBeyond(normal, offset + excess))
      {
        continue;
      }
      this->IsOnHull[first] = 1;
      waiting.push_back(first);
      while (!waiting.empty())
      {
        const std::size_t t = waiting.back();
        waiting.pop_back();
        for (const std::int32_t neighbour : neighbours[t])
        {
          const auto other = static_cast<std::size_t>(neighbour);
          if (!this->IsOnHull[other] && isInPlane(other, first))
          {
            isKnown[other] = 1;
            this->IsOnHull[other] = 1;
            waiting.push_back(other);
          }
        }
      }
    }
  }

  bool isInPlane(std::size_t t, std::size_t reference) const
  {
    const double turn = 4 * roundingAt(reference) / this->Heights[reference];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Point from = this->Surface.corner(t, i) - this->Surface.corner(reference, 0);
      const double most = 4 * roundingAt(t) + 1e-4 * this->Heights[t] + turn * norm(from);
      if (std::abs(dot(this->Normals[reference], from)) > most)
      {
        return false;
      }
    }
    return isSmooth(t, reference);
  }

  bool isSmooth(std::size_t one, std::size_t other) const
  {
    return dot(this->Normals[one], this->Normals[other]) > cosineOfSmooth;
  }

  /// Of the hull: what hangs together in one plane and does not continue smoothly to other hull.
  std::vector<unsigned char> findFlatSides()
  {
    this->Parts = Classes(this->Surface.size());
    forNeighbours(
      [&](std::size_t one, std::size_t other)
      {
        if (this->IsOnHull[one] && this->IsOnHull[other] && areInOnePlane(one, other))
        {
          this->Parts.join(one, other);
        }
      });
    std::vector<int> sizes(this->Surface.size(), 0);
    for (std::size_t t = 0; t < this->Surface.size(); ++t)
    {
      ++sizes[this->Parts.rootOf(t)];
    }
    forNeighbours(
      [&](std::size_t one, std::size_t other)
      {
        if (this->IsOnHull[one] && this->IsOnHull[other] && isSmooth(one, other) &&
          this->Parts.rootOf(one) != this->Parts.rootOf(other))
        {
          sizes[this->Parts.rootOf(one)] = sizes[this->Parts.rootOf(other)] = 0;
        }
      });
    std::vector<unsigned char> isFlat(this->Surface.size());
    for (std::size_t t = 0; t < this->Surface.size(); ++t)
    {
      isFlat[t] = this->IsOnHull[t] && sizes[this->Parts.rootOf(t)] >= fewestOfFlat ? 1 : 0;
    }
    return isFlat;
  }

  std::vector<unsigned char> joinOthers()
  {
    const std::vector<unsigned char> isFlat = findFlatSides();
    this->Parts = Classes(this->Surface.size());
    forNeighbours(
      [&](std::size_t one, std::size_t other)
      {
        if (!this->IsOnHull[one] && !this->IsOnHull[other] && isSmooth(one, other))
        {
          this->Parts.join(one, other);
        }
      });
    std::vector<unsigned char> isOuter(this->Surface.size(), 0); // of roots
    forNeighbours(
      [&](std::size_t one, std::size_t other)
      {
        if (this->IsOnHull[one] != this->IsOnHull[other])
        {
          const std::size_t hull = this->IsOnHull[one] ? one : other;
          if (!isFlat[hull] && isSmooth(one, other))
          {
            isOuter[this->Parts.rootOf(this->IsOnHull[one] ? other : one)] = 1;
          }
        }
      });
    markThoseAtTheBox(isOuter);
    std::vector<unsigned char> result(this->Surface.size());
    for (std::size_t t = 0; t < this->Surface.size(); ++t)
    {
      result[t] = this->IsOnHull[t] || isOuter[this->Parts.rootOf(t)] ? 1 : 0;
    }
    return result;
  }

  void markThoseAtTheBox(std::vector<unsigned char>& isOuter)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Point low{ infinity, infinity, infinity }, high{ -infinity, -infinity, -infinity };
    for (std::size_t t = 0; t < this->Surface.size(); ++t)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          low[axis] = std::min(low[axis], this->Surface.corner(t, i)[axis]);
          high[axis] = std::max(high[axis], this->Surface.corner(t, i)[axis]);
        }
      }
    }
    // Collects, at each point, the sides of the box that the hull faces (bits 0 to 5: -x, x, -y
    // ...).
    std::vector<unsigned char> faced(this->Surface.points.size(), 0);
    for (std::size_t t = 0; t < this->Surface.size(); ++t)
    {
      unsigned sides = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        sides |= this->Normals[t][axis] < -cosineOfFacing ? 1u << (2 * axis) : 0;
        sides |= this->Normals[t][axis] > cosineOfFacing ? 2u << (2 * axis) : 0;
      }
      for (std::size_t i = 0; i < 3 && this->IsOnHull[t]; ++i)
      {
        auto& atPoint = faced[static_cast<std::size_t>(this->Surface.corners[t][i])];
        atPoint = static_cast<unsigned char>(atPoint | sides);
      }
    }
    for (std::size_t t = 0; t < this->Surface.size(); ++t)
    {
      const double most = roundingAt(t) + touchingPart * this->Heights[t];
      for (std::size_t i = 0; i < 3 && !this->IsOnHull[t]; ++i)
      {
        const Point& x = this->Surface.corner(t, i);
        const unsigned facedHere = faced[static_cast<std::size_t>(this->Surface.corners[t][i])];
        for (std::size_t axis = 0; axis < this->Axes; ++axis)
        {
          const bool touchesLow = x[axis] <= low[axis] + most;
          const bool touchesHigh = x[axis] >= high[axis] - most;
          if ((touchesLow && !(facedHere & (1u << (2 * axis)))) ||
            (touchesHigh && !(facedHere & (2u << (2 * axis)))))
          {
            isOuter[this->Parts.rootOf(t)] = 1;
          }
        }
      }
    }
  }

  const Triangles& Surface;
  const TriangleTree& Tree;
  double Rounding;
  std::size_t Axes;
  std::vector<EdgeOfTriangle> Edges;
  std::vector<Point> Normals; // outward
  std::vector<double> Heights;
  std::vector<unsigned char> IsOnHull;
  Classes Parts{ 0 };
};

} // namespace

std::vector<unsigned char> findOuter(
  const Triangles& surface, const TriangleTree& tree, double rounding, std::size_t axes)
{
  return Finder(surface, tree, rounding, axes).find();
}

} // namespace filters
