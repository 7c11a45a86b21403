// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Thickens what is thinner than a voxel, so that no ray passes between two points of a lattice.
#include "Walls/LatticeSampling.h"

#include <algorithm>
#include <cmath>

namespace filters
{

namespace
{

constexpr float depthOfThin = 0.5f;
constexpr float squaredDiagonal = 3.001f; // of a voxel
constexpr double cosineOfThin = -0.1;     // of the sides of a thin solid
constexpr double cosineOfSides = -0.5;    // of gas beside a point in a wall
constexpr double cosineOfPlane = 0.9;     // of a nearly plane wall
constexpr double besideThin = 0.5;        // voxels
constexpr float onSurface =
  1e-3f; // distance to a surface below which points count to the side of its normal

} // namespace

/// Returns whether a place is over a triangle, or no farther beside it than `slack` voxels.
bool LatticeSampling::isOver(const Near& near, const Point& place, double slack)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point edge = unit(near.corners[(i + 1) % 3] - near.corners[i]);
    if (dot(cross(edge, place - near.corners[i]), near.normal) < -slack)
    {
      return false;
    }
  }
  return true;
}

/// Finds the points with gas beside a solid.
void LatticeSampling::findBeside()
{
  this->BesideAt.assign(this->States.size(), -1);
  this->Beside.clear();
  const unsigned char* const states = this->States.data();
  const float* const squared = this->SquaredToSolid.data();
  this->forPoints([=](std::size_t p)
    { return states[p] == InGas && squared[p] <= squaredDiagonal; },
    [&](const Index& at, std::size_t p)
    {
      const Point place = placeOf(at);
      const Near& near = this->Nearby[static_cast<std::size_t>(this->NearestSolid[p])];
      const bool isBehind = dot(near.normal, place - near.corners[0]) < 0 &&
        this->SquaredToSolid[p] > onSurface * onSurface;
      this->BesideAt[p] = static_cast<std::int32_t>(this->Beside.size());
      this->Beside.push_back({ at, p, place, isBehind ? -1. * near.normal : near.normal, &near });
    });
}

bool LatticeSampling::GasBeside::isOver() const
{
  if (!this->IsOver)
  {
    this->IsOver = LatticeSampling::isOver(*this->near, this->place, besideThin);
  }
  return *this->IsOver;
}

/// Marks points, so that no wall separates corners with gas of the voxel from `low` to low + (1, 1,
/// 1).
void LatticeSampling::separate(const Index& low)
{
  std::array<const GasBeside*, 8> corners{};
  std::size_t count = 0;
  bool areOfOne = true; // side of one triangle, that separates none of them
  for (int c = 0; c < (this->Lattice.points[2] > 1 ? 8 : 4); ++c)
  {
    const std::size_t p =
      this->numberOf({ low.i + (c & 1), low.j + (c >> 1 & 1), low.k + (c >> 2) });
    if (const std::int32_t n = this->BesideAt[p]; n >= 0)
    {
      const GasBeside& corner = this->Beside[static_cast<std::size_t>(n)];
      corners[count++] = &corner;
      areOfOne = areOfOne && corner.near == corners[0]->near && corner.side == corners[0]->side;
    }
  }
  if (areOfOne)
  {
    return;
  }
  // Finds which corners are behind the walls that others are in front of.
  double heights[8][8]; // over the wall of the first, of the second
  bool isAnyBehind = false;
  for (std::size_t a = 0; a < count; ++a)
  {
    for (std::size_t b = 0; b < count; ++b)
    {
      heights[a][b] = corners[a]->heightOf(corners[b]->place);
      isAnyBehind = isAnyBehind || (a != b && heights[a][b] < onSurface);
    }
  }
  if (!isAnyBehind)
  {
    return;
  }
  // Whether a line from one to the other enters the one's wall before it leaves the other's.
  const auto areApart = [&](std::size_t a, std::size_t b, double cosine)
  {
    return heights[a][b] < onSurface && heights[b][a] < onSurface &&
      heights[a][a] * heights[b][b] <= heights[a][b] * heights[b][a] + onSurface &&
      dot(corners[a]->side, corners[b]->side) < cosine;
  };
  std::array<unsigned, 8> together{}; // bits of the others that each corner is not apart from
  for (std::size_t a = 0; a < count; ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      const bool are = !areApart(a, b, cosineOfPlane);
      together[a] |= are ? 1u << b : 0;
      together[b] |= are ? 1u << a : 0;
    }
  }
  for (std::size_t a = 0; a < count; ++a)
  {
    for (std::size_t b = 0; b < count; ++b)
    {
      const GasBeside &one = *corners[a], &other = *corners[b];
      // Around an edge a third corner sees both.
      const bool areOpposite = a != b && ((together[a] >> b) & 1) == 0 &&
        ((together[a] & together[b]) == 0 || areApart(a, b, cosineOfThin));
      // Either is behind what the other is in front of, or one is between two walls.
      const bool areSeparated = one.isOver() && other.isOver() &&
        (areOpposite ? a < b : heights[a][b] < -onSurface && isOver(*one.near, other.place, 0));
      if (!areSeparated)
      {
        continue;
      }
      // The plane halfway between the walls, or the wall, separates other corners, too.
      const Point across = areOpposite ? unit(one.side - other.side) : one.side;
      const Point on = areOpposite ? 0.5 * (one.foot() + other.foot()) : one.foot();
      double front = 0, behind = 0;
      for (std::size_t n = 0; n < count; ++n)
      {
        const double over = dot(across, corners[n]->place - on);
        front = std::max(front, corners[n]->isOver() ? over : 0);
        behind = std::max(behind, corners[n]->isOver() ? -over : 0);
      }
      for (std::size_t n = 0; n < count; ++n)
      {
        const double over = dot(across, corners[n]->place - on);
        if (corners[n]->isOver() && std::abs(over) <= (over >= 0 ? behind : front) + onSurface)
        {
          this->Marked[corners[n]->number] = 1;
        }
      }
    }
  }
}

/// Marks points in walls that have gas on two opposite sides.
void LatticeSampling::markThin(const GasBeside& one)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int i = axis == 0 ? 1 : 0, j = axis == 1 ? 1 : 0, k = axis == 2 ? 1 : 0;
    const Index& at = one.at;
    const Index other{ at.i + 2 * i, at.j + 2 * j, at.k + 2 * k };
    if (!this->holds(other))
    {
      continue;
    }
    const std::size_t between = this->numberOf({ at.i + i, at.j + j, at.k + k });
    const std::int32_t beside = this->BesideAt[this->numberOf(other)];
    if (beside >= 0 && this->States[between] == InWall && this->Distances[between] > -depthOfThin &&
      dot(one.side, this->Beside[static_cast<std::size_t>(beside)].side) < cosineOfSides)
    {
      this->Marked[between] = 1;
    }
  }
}

void LatticeSampling::thickenPlates()
{
  this->findBeside();
  if (this->Beside.empty())
  {
    return; // and no wall is between two of them
  }
  this->Marked.assign(this->States.size(), 0);
  std::vector<unsigned char> corners(this->States.size(), 0); // of the voxel from each point on
  const bool isLayer = this->Lattice.points[2] == 1;          // whose voxels are squares
  for (const GasBeside& beside : this->Beside)
  {
    const Index& at = beside.at;
    for (int c = 0; c < (isLayer ? 4 : 8); ++c)
    {
      const Index low{ at.i - (c & 1), at.j - (c >> 1 & 1), at.k - (c >> 2) };
      const Index high{ low.i + 1, low.j + 1, low.k + (isLayer ? 0 : 1) };
      if (this->holds(low) && this->holds(high) && ++corners[this->numberOf(low)] == 2)
      {
        this->separate(low);
      }
    }
    this->markThin(beside);
  }
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
