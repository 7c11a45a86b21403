// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Thickens what is thinner than a voxel, so that no ray passes between two points of a lattice.
#include "Walls/LatticeSampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace filters
{

namespace
{

constexpr float depthOfThin = 0.5f;
constexpr float squaredDiagonal = 3.001f; // of a voxel
constexpr float cosineOfPlane = 0.9f;
constexpr double besideVoxel = 0.01; // distance at which walls count as meeting it
constexpr float onSurface =
  1e-3f; // distance to a surface below which points count to the side of its normal

/// Returns the fraction of a line at which a triangle crosses it; negative: nowhere.
double crossingOf(
  const std::array<Point, 3>& t, const Point& normal, const Point& from, const Point& to)
{
  constexpr double slack = 1e-9; // closes the gap between two triangles
  const Point line = to - from;
  const double fraction = dot(normal, t[0] - from) / dot(normal, line);
  if (!(fraction >= -slack && fraction <= 1 + slack)) // NaN, too
  {
    return -1;
  }
  const Point at = from + fraction * line;
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point edge = t[(i + 1) % 3] - t[i];
    size = std::max(size, dot(edge, edge));
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (dot(cross(t[(i + 1) % 3] - t[i], at - t[i]), normal) < -slack * size)
    {
      return -1;
    }
  }
  return std::clamp(fraction, 0., 1.);
}

} // namespace

/// Finds the side of the nearest solid for each point that is nearer to it than to its neighbours.
void LatticeSampling::findSides()
{
  this->IsBeside.assign(this->States.size(), 0);
  this->Sides.assign(this->States.size(), { 0, 0, 0 });
  this->forPoints(
    [&](const Index& at)
    {
      const std::size_t p = this->numberOf(at);
      if (this->States[p] != InGas || this->SquaredToSolid[p] > squaredDiagonal)
      {
        return;
      }
      this->IsBeside[p] = 1;
      const Near& near = this->Nearby[static_cast<std::size_t>(this->NearestSolid[p])];
      const bool isBehind = dot(near.normal, placeOf(at) - near.corners[0]) < 0 &&
        this->SquaredToSolid[p] > onSurface * onSurface;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        this->Sides[p][axis] =
          static_cast<float>(isBehind ? -near.normal[axis] : near.normal[axis]);
      }
    });
}

/// Lists the walls and bodies of each row of voxels along x; coarse lattices may have many.
void LatticeSampling::findSolidsOfRows()
{
  const auto& points = this->Lattice.points;
  std::vector<std::size_t>& starts = this->StartsOfRows;
  starts.assign(static_cast<std::size_t>(points[1]) * static_cast<std::size_t>(points[2]) + 1, 0);
  const auto forRowsOf = [&](std::int32_t number, const auto& visit)
  {
    const Near& near = this->Nearby[static_cast<std::size_t>(number)];
    int first[3], last[3];
    for (std::size_t axis = 1; axis < 3; ++axis)
    {
      const auto [least, most] =
        std::minmax({ near.corners[0][axis], near.corners[1][axis], near.corners[2][axis] });
      const double end = points[axis] - 1;
      first[axis] = static_cast<int>(std::clamp(std::ceil(least - 1 - besideVoxel), 0., end));
      last[axis] = static_cast<int>(std::clamp(std::floor(most + besideVoxel), -1., end));
    }
    for (int k = first[2]; k <= last[2]; ++k)
    {
      for (int j = first[1]; j <= last[1]; ++j)
      {
        visit(this->rowOf({ 0, j, k }));
      }
    }
  };
  const auto forSolids = [&](const auto& visit)
  {
    for (const Kind kind : { Wall, Body })
    {
      std::for_each(this->Numbers[kind].begin(), this->Numbers[kind].end(), visit);
    }
  };
  forSolids(
    [&](std::int32_t number) { forRowsOf(number, [&](std::size_t row) { ++starts[row + 1]; }); });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  this->SolidsOfRows.resize(starts.back());
  std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
  forSolids([&](std::int32_t number)
    { forRowsOf(number, [&](std::size_t row) { this->SolidsOfRows[next[row]++] = number; }); });
}

/// Returns whether some of the places are in front of a triangle's plane and others behind it.
bool LatticeSampling::areOnBothSides(
  const Near& near, const std::array<Point, 8>& places, std::size_t count)
{
  bool isInFront = false, isBehind = false;
  for (std::size_t n = 0; n < count; ++n)
  {
    const bool isFront = dot(near.normal, places[n] - near.corners[0]) >= 0;
    isInFront = isInFront || isFront;
    isBehind = isBehind || !isFront;
  }
  return isInFront && isBehind;
}

/// Returns where walls separate two places, the mean of the first and the last of their crossings;
/// negative: nowhere. A line that only cuts off a bulge of a nearly plane wall begins and ends on the
/// same side of it.
double LatticeSampling::separationOf(
  const std::vector<const Near*>& walls, const Point& from, const Point& to)
{
  double first = 2, last = -1;
  const Near *wallOfFirst = nullptr, *wallOfLast = nullptr;
  for (const Near* wall : walls)
  {
    const double fraction = crossingOf(wall->corners, wall->normal, from, to);
    if (fraction >= 0 && fraction < first)
    {
      first = fraction;
      wallOfFirst = wall;
    }
    if (fraction > last)
    {
      last = fraction;
      wallOfLast = wall;
    }
  }
  if (last < 0)
  {
    return -1;
  }
  // Turns the normals to the places.
  const Point line = to - from;
  const double turns =
    (dot(wallOfFirst->normal, line) < 0 ? 1 : -1) * (dot(wallOfLast->normal, line) < 0 ? -1 : 1);
  const bool isBulge =
    turns * dot(wallOfFirst->normal, wallOfLast->normal) > double{ cosineOfPlane };
  return isBulge ? -1 : 0.5 * (first + last);
}

/// Marks points, so that no wall separates corners with gas of the voxel from `low` to low + (1, 1,
/// 1).
void LatticeSampling::separate(const Index& low)
{
  std::array<std::size_t, 8> numbers; // of the corners with gas
  std::array<Point, 8> places;
  std::size_t count = 0;
  const std::array<float, 3>* side = nullptr;
  std::array<const Near*, 8> nearest; // of the corners beside a wall
  std::size_t countNearest = 0;
  bool mayBeCrossed = false;
  const int corners = this->Lattice.points[2] > 1 ? 8 : 4;
  for (int c = 0; c < corners; ++c)
  {
    const Index at{ low.i + (c & 1), low.j + (c >> 1 & 1), low.k + (c >> 2) };
    const std::size_t p = this->numberOf(at);
    if (this->States[p] != InGas)
    {
      continue;
    }
    numbers[count] = p;
    places[count] = placeOf(at);
    if (this->IsBeside[p])
    {
      const Near* of = &this->Nearby[static_cast<std::size_t>(this->NearestSolid[p])];
      if (countNearest == 0 || nearest[countNearest - 1] != of)
      {
        nearest[countNearest++] = of;
      }
      const std::array<float, 3>& own = this->Sides[p];
      side = side ? side : &own;
      mayBeCrossed = mayBeCrossed ||
        (*side)[0] * own[0] + (*side)[1] * own[1] + (*side)[2] * own[2] < cosineOfPlane;
      if (this->SquaredToSolid[p] <= onSurface * onSurface)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          places[count][axis] += double{ onSurface } * own[axis];
        }
      }
    }
    ++count;
  }
  // Skips corners on one side of a nearly plane wall. Normals alone do not show that: the sides of
  // a narrow fold have nearly the same one, too.
  for (std::size_t n = 0; n < countNearest && !mayBeCrossed; ++n)
  {
    mayBeCrossed = areOnBothSides(*nearest[n], places, count);
  }
  if (!mayBeCrossed)
  {
    return;
  }
  this->separate(low, numbers, places, count);
}

/// Marks those of some corners that a wall separates from others.
void LatticeSampling::separate(const Index& low, const std::array<std::size_t, 8>& numbers,
  const std::array<Point, 8>& places, std::size_t count)
{
  if (this->StartsOfRows.empty())
  {
    this->findSolidsOfRows();
  }

  // Lists the walls that meet the voxel.
  std::vector<const Near*> walls;
  const std::size_t row = this->rowOf(low);
  for (std::size_t n = this->StartsOfRows[row]; n < this->StartsOfRows[row + 1]; ++n)
  {
    const Near& near = this->Nearby[static_cast<std::size_t>(this->SolidsOfRows[n])];
    const auto [least, most] =
      std::minmax({ near.corners[0][0], near.corners[1][0], near.corners[2][0] });
    if (least <= low.i + 1 + besideVoxel && most >= low.i - besideVoxel)
    {
      walls.push_back(&near);
    }
  }
  if (walls.empty())
  {
    return;
  }
  std::array<int, 8> sides{ 0, 1, 2, 3, 4, 5, 6, 7 }; // equal number: not separated
  double crossing[8][8];
  for (std::size_t a = 0; a < count; ++a)
  {
    for (std::size_t b = a + 1; b < count; ++b)
    {
      crossing[a][b] = separationOf(walls, places[a], places[b]);
      if (crossing[a][b] < 0)
      {
        joinSides(sides, a, b);
      }
    }
  }
  for (std::size_t a = 0; a < count; ++a)
  {
    for (std::size_t b = a + 1; b < count; ++b)
    {
      if (sides[a] != sides[b])
      {
        if (crossing[a][b] < 0.5 + 1e-3)
        {
          this->Marked[numbers[a]] = 1;
        }
        if (crossing[a][b] > 0.5 - 1e-3)
        {
          this->Marked[numbers[b]] = 1;
        }
      }
    }
  }
}

/// Returns whether there is gas on two opposite sides of a point in a wall.
bool LatticeSampling::isThin(const Index& at) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int i = axis == 0 ? 1 : 0, j = axis == 1 ? 1 : 0, k = axis == 2 ? 1 : 0;
    const Index one{ at.i - i, at.j - j, at.k - k }, other{ at.i + i, at.j + j, at.k + k };
    if (this->holds(one) && this->holds(other))
    {
      const std::array<float, 3>&a = this->Sides[this->numberOf(one)],
                              &b = this->Sides[this->numberOf(other)];
      if (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] < -0.5f)
      {
        return true;
      }
    }
  }
  return false;
}

void LatticeSampling::thickenPlates()
{
  this->findSides();
  this->Marked.assign(this->States.size(), 0);
  const auto& points = this->Lattice.points;
  // Allows for flat lattices, whose voxels are squares.
  const int layers = std::max(1, points[2] - 1);
  const int up = points[2] > 1 ? 1 : 0;
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j + 1 < points[1]; ++j)
    {
      const unsigned char* rows[4] = { &this->IsBeside[this->numberOf({ 0, j, k })],
        &this->IsBeside[this->numberOf({ 0, j + 1, k })],
        &this->IsBeside[this->numberOf({ 0, j, k + up })],
        &this->IsBeside[this->numberOf({ 0, j + 1, k + up })] };
      for (int i = 0; i + 1 < points[0]; ++i)
      {
        int beside = 0;
        for (const unsigned char* row : rows)
        {
          beside += row[i] + row[i + 1];
        }
        if (beside > 1)
        {
          this->separate({ i, j, k });
        }
      }
    }
  }
  this->forPoints(
    [&](const Index& at)
    {
      const std::size_t p = this->numberOf(at);
      if (this->States[p] == InWall && this->Distances[p] > -depthOfThin && this->isThin(at))
      {
        this->Marked[p] = 1;
      }
    });
  for (std::size_t p = 0; p < this->Marked.size(); ++p)
  {
    if (this->Marked[p])
    {
      this->States[p] = InWall;
      this->Distances[p] = std::min(this->Distances[p], -depthOfThin);
    }
  }
}

} // namespace filters
