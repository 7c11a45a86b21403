// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "OuterFaces.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace filters
{

namespace
{

constexpr double bulge = 0.1;           // how far the hull may reach out, in heights of a triangle
constexpr double cosineOfSmooth = 0.82; // 35 degrees
constexpr double sineOfFlat = 5e-3;     // 0.3 degrees
constexpr int fewestOfFlat = 5;         // triangles; fewer are a facet of something curved
constexpr double cosineOfFacing = 0.5;  // 60 degrees
constexpr double touchingPart = 1e-4;   // of a triangle's height

class Finder
{
public:
  Finder(const Triangles& surface, const TriangleTree& tree, double rounding, std::size_t axes)
    : surface_(surface)
    , tree_(tree)
    , rounding_(rounding)
    , axes_(axes)
    , edges_(edgesOf(surface))
    , normals_(surface.size())
    , heights_(surface.size())
    , isOnHull_(surface.size(), 0)
  {
    for (std::size_t t = 0; t < surface.size(); ++t)
    {
      const Point normal = surface.normal(t);
      normals_[t] = -1. * unit(normal); // outward
      double longest = 0;
      for (std::size_t i = 0; i < 3; ++i)
      {
        longest = std::max(longest, norm(surface.corner(t, i) - surface.corner(t, (i + 1) % 3)));
      }
      heights_[t] = longest > 0 ? norm(normal) / longest : 0;
    }
  }

  std::vector<unsigned char> find()
  {
    findHull();
    return joinOthers();
  }

private:
  double roundingAt(std::size_t t) const { return rounding_ * norm(surface_.corner(t, 0)); }

  /// Calls visit(one, other) for triangles at the same edge.
  template <class Visit>
  void forNeighbours(const Visit& visit) const
  {
    for (std::size_t i = 1; i < edges_.size(); ++i)
    {
      if (edges_[i].isSameEdge(edges_[i - 1]))
      {
        visit(static_cast<std::size_t>(edges_[i - 1].triangle),
          static_cast<std::size_t>(edges_[i].triangle));
      }
    }
  }

  bool areInOnePlane(std::size_t one, std::size_t other) const
  {
    const double noise = (roundingAt(one) + roundingAt(other)) /
      std::max(std::min(heights_[one], heights_[other]), std::numeric_limits<double>::min());
    return norm(cross(normals_[one], normals_[other])) < sineOfFlat + 4 * noise &&
      dot(normals_[one], normals_[other]) > 0;
  }

  void findHull()
  {
    // Sides of the domain are flat: what lies in the plane of a triangle on the hull is on it, too.
    std::vector<std::vector<std::int32_t>> neighbours(surface_.size());
    forNeighbours(
      [&](std::size_t one, std::size_t other)
      {
        neighbours[one].push_back(static_cast<std::int32_t>(other));
        neighbours[other].push_back(static_cast<std::int32_t>(one));
      });
    // The larger a triangle is, the less rounding turns its plane: they come first.
    std::vector<std::size_t> sorted(surface_.size());
    std::iota(sorted.begin(), sorted.end(), std::size_t{ 0 });
    std::stable_sort(sorted.begin(), sorted.end(),
      [&](std::size_t a, std::size_t b) { return heights_[a] > heights_[b]; });
    std::vector<unsigned char> isKnown(surface_.size(), 0);
    std::vector<std::size_t> waiting;
    for (const std::size_t first : sorted)
    {
      if (isKnown[first])
      {
        continue;
      }
      isKnown[first] = 1;
      const Point normal = normals_[first];
      const double offset = dot(normal, surface_.corner(first, 0));
      const double excess = bulge * heights_[first] + 4 * roundingAt(first);
      if (!(heights_[first] > 0) || tree_.hasBeyond(normal, offset + excess))
      {
        continue;
      }
      isOnHull_[first] = 1;
      waiting.push_back(first);
      while (!waiting.empty())
      {
        const std::size_t t = waiting.back();
        waiting.pop_back();
        for (const std::int32_t neighbour : neighbours[t])
        {
          const auto other = static_cast<std::size_t>(neighbour);
          if (!isOnHull_[other] && isInPlane(other, first))
          {
            isKnown[other] = 1;
            isOnHull_[other] = 1;
            waiting.push_back(other);
          }
        }
      }
    }
  }

  bool isInPlane(std::size_t t, std::size_t reference) const
  {
    const double turn = 4 * roundingAt(reference) / heights_[reference];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Point from = surface_.corner(t, i) - surface_.corner(reference, 0);
      const double most = 4 * roundingAt(t) + 1e-4 * heights_[t] + turn * norm(from);
      if (std::abs(dot(normals_[reference], from)) > most)
      {
        return false;
      }
    }
    return isSmooth(t, reference);
  }

  bool isSmooth(std::size_t one, std::size_t other) const
  {
    return dot(normals_[one], normals_[other]) > cosineOfSmooth;
  }

  void resetRoots()
  {
    roots_.resize(surface_.size());
    std::iota(roots_.begin(), roots_.end(), std::size_t{ 0 });
  }

  void join(std::size_t one, std::size_t other)
  {
    const auto [low, high] = std::minmax({ rootOf(one), rootOf(other) });
    roots_[high] = low;
  }

  std::size_t rootOf(std::size_t t)
  {
    while (roots_[t] != t)
    {
      roots_[t] = roots_[roots_[t]];
      t = roots_[t];
    }
    return t;
  }

  /// Of the hull: what hangs together in one plane and does not continue smoothly to other hull.
  std::vector<unsigned char> findFlatSides()
  {
    resetRoots();
    forNeighbours(
      [&](std::size_t one, std::size_t other)
      {
        if (isOnHull_[one] && isOnHull_[other] && areInOnePlane(one, other))
        {
          join(one, other);
        }
      });
    std::vector<int> sizes(surface_.size(), 0);
    for (std::size_t t = 0; t < surface_.size(); ++t)
    {
      ++sizes[rootOf(t)];
    }
    forNeighbours(
      [&](std::size_t one, std::size_t other)
      {
        if (isOnHull_[one] && isOnHull_[other] && isSmooth(one, other) &&
          rootOf(one) != rootOf(other))
        {
          sizes[rootOf(one)] = sizes[rootOf(other)] = 0;
        }
      });
    std::vector<unsigned char> isFlat(surface_.size());
    for (std::size_t t = 0; t < surface_.size(); ++t)
    {
      isFlat[t] = isOnHull_[t] && sizes[rootOf(t)] >= fewestOfFlat ? 1 : 0;
    }
    return isFlat;
  }

  std::vector<unsigned char> joinOthers()
  {
    const std::vector<unsigned char> isFlat = findFlatSides();
    resetRoots();
    forNeighbours(
      [&](std::size_t one, std::size_t other)
      {
        if (!isOnHull_[one] && !isOnHull_[other] && isSmooth(one, other))
        {
          join(one, other);
        }
      });
    std::vector<unsigned char> isOuter(surface_.size(), 0); // of roots
    forNeighbours(
      [&](std::size_t one, std::size_t other)
      {
        if (isOnHull_[one] != isOnHull_[other])
        {
          const std::size_t hull = isOnHull_[one] ? one : other;
          if (!isFlat[hull] && isSmooth(one, other))
          {
            isOuter[rootOf(isOnHull_[one] ? other : one)] = 1;
          }
        }
      });
    markThoseAtTheBox(isOuter);
    std::vector<unsigned char> result(surface_.size());
    for (std::size_t t = 0; t < surface_.size(); ++t)
    {
      result[t] = isOnHull_[t] || isOuter[rootOf(t)] ? 1 : 0;
    }
    return result;
  }

  void markThoseAtTheBox(std::vector<unsigned char>& isOuter)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Point low{ infinity, infinity, infinity }, high{ -infinity, -infinity, -infinity };
    for (std::size_t t = 0; t < surface_.size(); ++t)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          low[axis] = std::min(low[axis], surface_.corner(t, i)[axis]);
          high[axis] = std::max(high[axis], surface_.corner(t, i)[axis]);
        }
      }
    }
    // The sides of the box (bits 0 to 5: -x, x, -y ...) that the hull faces at each point.
    std::vector<unsigned char> faced(surface_.points.size(), 0);
    for (std::size_t t = 0; t < surface_.size(); ++t)
    {
      unsigned sides = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        sides |= normals_[t][axis] < -cosineOfFacing ? 1u << (2 * axis) : 0;
        sides |= normals_[t][axis] > cosineOfFacing ? 2u << (2 * axis) : 0;
      }
      for (std::size_t i = 0; i < 3 && isOnHull_[t]; ++i)
      {
        auto& atPoint = faced[static_cast<std::size_t>(surface_.corners[t][i])];
        atPoint = static_cast<unsigned char>(atPoint | sides);
      }
    }
    for (std::size_t t = 0; t < surface_.size(); ++t)
    {
      const double most = roundingAt(t) + touchingPart * heights_[t];
      for (std::size_t i = 0; i < 3 && !isOnHull_[t]; ++i)
      {
        const Point& x = surface_.corner(t, i);
        const unsigned facedHere = faced[static_cast<std::size_t>(surface_.corners[t][i])];
        for (std::size_t axis = 0; axis < axes_; ++axis)
        {
          const bool touchesLow = x[axis] <= low[axis] + most;
          const bool touchesHigh = x[axis] >= high[axis] - most;
          if ((touchesLow && !(facedHere & (1u << (2 * axis)))) ||
            (touchesHigh && !(facedHere & (2u << (2 * axis)))))
          {
            isOuter[rootOf(t)] = 1;
          }
        }
      }
    }
  }

  const Triangles& surface_;
  const TriangleTree& tree_;
  double rounding_;
  std::size_t axes_;
  std::vector<EdgeOfTriangle> edges_;
  std::vector<Point> normals_; // outward
  std::vector<double> heights_;
  std::vector<unsigned char> isOnHull_;
  std::vector<std::size_t> roots_;
};

} // namespace

std::vector<unsigned char> findOuter(
  const Triangles& surface, const TriangleTree& tree, double rounding, std::size_t axes)
{
  return Finder(surface, tree, rounding, axes).find();
}

} // namespace filters
