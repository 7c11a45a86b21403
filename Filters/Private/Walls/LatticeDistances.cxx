// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/LatticeDistances.h"

#include <algorithm>

namespace filters
{

namespace
{

/// offset + dot(slope, x) with a slope of length 1: the distance from a plane. The offset is
/// computed in double precision, for triangles much larger than the lattice.
struct Plane
{
  float slope[3];
  float offset;

  Plane() = default;
  Plane(const Point& normal, const Point& through)
    : slope{ static_cast<float>(normal[0]), static_cast<float>(normal[1]),
      static_cast<float>(normal[2]) }
    , offset(static_cast<float>(-dot(normal, through)))
  {
  }
  /// Returns the plane's height at the start of a row along x.
  float inRow(float j, float k) const { return offset + slope[1] * j + slope[2] * k; }
};

struct Edge
{
  Plane across; // in the triangle's plane, positive outside
  Plane before; // positive before the edge's first corner
  Plane behind; // positive behind its second corner
};

struct Prepared
{
  Plane height;
  Edge edges[3];
};

/// Returns false if the triangle has no area.
bool prepare(const std::array<Point, 3>& corners, Prepared& prepared)
{
  const Point normal = unit(cross(corners[1] - corners[0], corners[2] - corners[0]));
  if (!(norm(normal) > 0.5))
  {
    return false;
  }
  prepared.height = Plane(normal, corners[0]);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point &a = corners[i], &b = corners[(i + 1) % 3];
    const Point along = unit(b - a);
    prepared.edges[i] = { Plane(cross(along, normal), a), Plane(-1. * along, a), Plane(along, b) };
  }
  return true;
}

/// A row of points along x. Loops over all lanes are separate, so that compilers vectorise them.
class Row
{
public:
  Row(const Prepared& t, float y, float z)
    : Height(t.height.inRow(y, z))
    , HeightSlope(t.height.slope[0])
  {
    for (int e = 0; e < 3; ++e)
    {
      const Edge& edge = t.edges[e];
      this->Edges[e] = { edge.across.inRow(y, z), edge.across.slope[0], edge.before.inRow(y, z),
        edge.before.slope[0], edge.behind.inRow(y, z), edge.behind.slope[0] };
    }
  }

  void update(int first, int end, std::int32_t number, float* __restrict squared,
    std::int32_t* __restrict nearest) const
  {
    const EdgeInRow e0 = this->Edges[0], e1 = this->Edges[1], e2 = this->Edges[2];
    const float height0 = this->Height, heightSlope = this->HeightSlope;
    for (int i = first; i < end; ++i)
    {
      const auto x = static_cast<float>(i);
      const float inPlane =
        std::min(std::min(squaredDistance(e0, x), squaredDistance(e1, x)), squaredDistance(e2, x));
      const float outside =
        std::max(std::max(e0.across + e0.acrossSlope * x, e1.across + e1.acrossSlope * x),
          e2.across + e2.acrossSlope * x);
      const float height = height0 + heightSlope * x;
      const float found = height * height + (outside > 0 ? inPlane : 0);
      const bool isNearer = found < squared[i];
      squared[i] = isNearer ? found : squared[i];
      nearest[i] = isNearer ? number : nearest[i];
    }
  }

private:
  struct EdgeInRow
  {
    float across, acrossSlope, before, beforeSlope, behind, behindSlope;
  };
  static float squaredDistance(const EdgeInRow& edge, float x)
  {
    const float across = edge.across + edge.acrossSlope * x;
    const float before = edge.before + edge.beforeSlope * x;
    const float behind = edge.behind + edge.behindSlope * x;
    const float beyond = std::max(std::max(before, behind), 0.f);
    return across * across + beyond * beyond;
  }

  float Height, HeightSlope;
  EdgeInRow Edges[3];
};

} // namespace

LatticeMetric::LatticeMetric(const schlieren::Lattice& lattice)
  : First(lattice.first)
  , PerUnit{ 1 / lattice.spacing[0], 1 / lattice.spacing[1], 1 / lattice.spacing[2] }
{
}

schlieren::Box boxAround(const schlieren::Lattice& lattice, double reach)
{
  schlieren::Box box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double spacing = lattice.spacing[axis];
    box.low[axis] = lattice.first[axis] - reach * spacing;
    box.high[axis] = lattice.first[axis] + (lattice.points[axis] - 1 + reach) * spacing;
  }
  return box;
}

LatticeDistances::LatticeDistances(const schlieren::Lattice& lattice, float reach)
  : Points(lattice.points)
  , Stride(static_cast<std::size_t>((lattice.points[0] + lanes - 1) / lanes * lanes))
  , Reach(reach)
{
  const std::size_t size = this->Stride * static_cast<std::size_t>(lattice.points[1]) *
    static_cast<std::size_t>(lattice.points[2]);
  this->Squared.assign(size, reach * reach);
  this->Nearest.assign(size, -1);
}

void LatticeDistances::add(const std::array<Point, 3>& corners, std::int32_t number)
{
  Prepared t;
  if (!prepare(corners, t))
  {
    return; // neighbouring triangles cover it
  }
  int first[3], last[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::minmax({ corners[0][axis], corners[1][axis], corners[2][axis] });
    const double most = this->Points[axis];
    first[axis] = static_cast<int>(std::clamp(std::ceil(low - this->Reach), 0., most));
    last[axis] = static_cast<int>(std::clamp(std::floor(high + this->Reach), -1., most - 1));
  }
  for (int k = first[2]; k <= last[2]; ++k)
  {
    for (int j = first[1]; j <= last[1]; ++j)
    {
      const auto y = static_cast<float>(j), z = static_cast<float>(k);
      // Finds the points within reach of the triangle's plane.
      const float height = t.height.inRow(y, z), slope = t.height.slope[0];
      float low = static_cast<float>(first[0]), high = static_cast<float>(last[0]);
      if (std::abs(slope) > 1e-3f)
      {
        const float middle = -height / slope, half = this->Reach / std::abs(slope);
        low = std::max(low, middle - half);
        high = std::min(high, middle + half);
      }
      else if (std::abs(height) > this->Reach + 0.1f)
      {
        continue;
      }
      if (low > high)
      {
        continue;
      }
      const int start = static_cast<int>(low) / lanes * lanes;
      const int end = (static_cast<int>(high) / lanes + 1) * lanes;
      const std::size_t at = this->row(j, k);
      Row(t, y, z).update(start, end, number, this->Squared.data() + at, this->Nearest.data() + at);
    }
  }
}

} // namespace filters
