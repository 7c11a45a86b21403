// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeDistances.h"

#include <algorithm>

namespace refractivity
{

namespace
{

/// offset + dot(slope, place), where the slope's length is 1: a distance from a plane. The offset is found in
/// double precision, for triangles much larger than the lattice.
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
  /// Along x.
  float inRow(float j, float k) const { return offset + slope[1] * j + slope[2] * k; }
};

struct Edge
{
  Plane across; // in the triangle's plane, positive outside of it
  Plane before; // positive before the edge's first corner
  Plane behind; // positive behind its second one
};

struct Prepared
{
  Plane height;
  Edge edges[3];
};

/// False where the triangle has no area.
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
    return; // the triangles beside it are there, too
  }
  int first[3], last[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::minmax({ corners[0][axis], corners[1][axis], corners[2][axis] });
    const double most = this->Points[axis];
    first[axis] = static_cast<int>(std::clamp(std::ceil(low - this->Reach), 0., most));
    last[axis] = static_cast<int>(std::clamp(std::floor(high + this->Reach), -1., most - 1));
  }
  const float firstX = static_cast<float>(first[0]), lastX = static_cast<float>(last[0]);
  for (int k = first[2]; k <= last[2]; ++k)
  {
    for (int j = first[1]; j <= last[1]; ++j)
    {
      const auto y = static_cast<float>(j), z = static_cast<float>(k);
      const float height = t.height.inRow(y, z), slope = t.height.slope[0];
      const float one = height + slope * firstX, other = height + slope * lastX;
      if (std::min(one, other) > this->Reach || std::max(one, other) < -this->Reach)
      {
        continue;
      }
      float across[3], before[3], behind[3];
      for (int e = 0; e < 3; ++e)
      {
        across[e] = t.edges[e].across.inRow(y, z);
        before[e] = t.edges[e].before.inRow(y, z);
        behind[e] = t.edges[e].behind.inRow(y, z);
      }
      for (int start = first[0] / lanes * lanes; start <= last[0]; start += lanes)
      {
        float* squared = this->Squared.data() + this->place(start, j, k);
        std::int32_t* nearest = this->Nearest.data() + this->place(start, j, k);
        for (int lane = 0; lane < lanes; ++lane)
        {
          const auto x = static_cast<float>(start + lane);
          const float h = height + slope * x;
          float inPlane = 1e30f, outside = 0;
          for (int e = 0; e < 3; ++e)
          {
            const float a = across[e] + t.edges[e].across.slope[0] * x;
            const float b = before[e] + t.edges[e].before.slope[0] * x;
            const float c = behind[e] + t.edges[e].behind.slope[0] * x;
            float beyond = b > c ? b : c;
            beyond = beyond > 0 ? beyond : 0;
            const float d = a * a + beyond * beyond;
            inPlane = d < inPlane ? d : inPlane;
            outside = a > outside ? a : outside;
          }
          inPlane = outside > 0 ? inPlane : 0;
          const float d = h * h + inPlane;
          const bool isNearer = d < squared[lane];
          squared[lane] = isNearer ? d : squared[lane];
          nearest[lane] = isNearer ? number : nearest[lane];
        }
      }
    }
  }
}

} // namespace refractivity
