// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeSampling.h"

#include <algorithm>

namespace refractivity
{

namespace
{

constexpr float smallest = 1.f / 4096; // distances are never 0
constexpr float depthOfThin = 0.5f;
constexpr float onSurface =
  1e-3f;                     // points so near to a surface are counted to the side of its normal
constexpr float tie = 1e-3f; // of the distances to two faces
constexpr float diagonal = 1.7321f;

constexpr int steps[6][3] = { { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, -1 },
  { 0, 0, 1 } };

/// The part of the line from one place to another at which a triangle lies across it; negative: nowhere.
double crossingOf(
  const std::array<Point, 3>& t, const Point& normal, const Point& from, const Point& to)
{
  constexpr double slack = 1e-9; // so that no line slips through between two triangles
  const Point line = to - from;
  const double share = dot(normal, t[0] - from) / dot(normal, line);
  if (!(share >= -slack && share <= 1 + slack)) // NaN, too
  {
    return -1;
  }
  const Point at = from + share * line;
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
  return std::clamp(share, 0., 1.);
}

} // namespace

LatticeSampling::LatticeSampling(const schlieren::Lattice& lattice)
  : Lattice(lattice)
  , Metric(lattice)
{
}

template <class Visit>
void LatticeSampling::forPoints(const Visit& visit) const
{
  for (int k = 0; k < this->Lattice.points[2]; ++k)
  {
    for (int j = 0; j < this->Lattice.points[1]; ++j)
    {
      for (int i = 0; i < this->Lattice.points[0]; ++i)
      {
        visit(Index{ i, j, k });
      }
    }
  }
}

void LatticeSampling::add(Kind kind, const Triangles& surface, std::int32_t triangle)
{
  const auto t = static_cast<std::size_t>(triangle);
  Near near;
  for (std::size_t i = 0; i < 3; ++i)
  {
    near.corners[i] = this->Metric.at(surface.corner(t, i));
  }
  near.normal = unit(cross(near.corners[1] - near.corners[0], near.corners[2] - near.corners[0]));
  const auto number = static_cast<std::int32_t>(this->Nearby.size());
  this->Nearby.push_back(near);
  this->Numbers[kind].push_back(number);
  std::unique_ptr<LatticeDistances>& field = this->Fields[kind];
  if (!field)
  {
    field = std::make_unique<LatticeDistances>(this->Lattice, schlieren::MediumSource::reach);
  }
  field->add(near.corners, number);
}

void LatticeSampling::addFaces(
  const Triangles& surface, const TriangleTree& tree, const std::vector<unsigned char>& walls)
{
  tree.forTrianglesAt(boxAround(this->Lattice, schlieren::MediumSource::reach),
    [&](std::int32_t triangle)
    { this->add(walls[static_cast<std::size_t>(triangle)] ? Wall : Window, surface, triangle); });
}

bool LatticeSampling::addBodies(const Triangles& surface, const TriangleTree& tree)
{
  tree.forTrianglesAt(boxAround(this->Lattice, schlieren::MediumSource::reach),
    [&](std::int32_t triangle) { this->add(Body, surface, triangle); });
  return this->Fields[Body] != nullptr;
}

float LatticeSampling::distanceTo(Kind kind, const Index& at) const
{
  return this->Fields[kind] ? this->Fields[kind]->at(at.i, at.j, at.k)
                            : schlieren::MediumSource::reach;
}

std::int32_t LatticeSampling::nearestOf(Kind kind, const Index& at) const
{
  return this->Fields[kind] ? this->Fields[kind]->nearest(at.i, at.j, at.k) : -1;
}

float LatticeSampling::distanceToSolid(const Index& at) const
{
  return std::min(this->distanceTo(Wall, at), this->distanceTo(Body, at));
}

std::int32_t LatticeSampling::nearestSolid(const Index& at) const
{
  return this->nearestOf(this->distanceTo(Body, at) < this->distanceTo(Wall, at) ? Body : Wall, at);
}

/// The normal of the nearest wall, turned to the side on which the point is.
Point LatticeSampling::normalTowards(const Index& at) const
{
  const std::int32_t nearest = this->nearestSolid(at);
  if (nearest < 0)
  {
    return { 0, 0, 0 };
  }
  const Near& near = this->Nearby[static_cast<std::size_t>(nearest)];
  const Point place{ static_cast<double>(at.i), static_cast<double>(at.j),
    static_cast<double>(at.k) };
  const double height = dot(near.normal, place - near.corners[0]);
  const bool isBehind = height < 0 && this->distanceToSolid(at) > onSurface;
  return isBehind ? -1. * near.normal : near.normal;
}

/// Of a wall and a window that are equally near, at a common edge, the one whose plane is farther away faces the
/// point more.
bool LatticeSampling::isWallNearer(const Index& at) const
{
  const float toWall = this->distanceTo(Wall, at), toWindow = this->distanceTo(Window, at);
  if (std::abs(toWall - toWindow) > tie || this->nearestOf(Wall, at) < 0 ||
    this->nearestOf(Window, at) < 0)
  {
    return toWall < toWindow;
  }
  const Point place{ static_cast<double>(at.i), static_cast<double>(at.j),
    static_cast<double>(at.k) };
  const auto heightOver = [&](Kind kind)
  {
    const Near& near = this->Nearby[static_cast<std::size_t>(this->nearestOf(kind, at))];
    return std::abs(dot(near.normal, place - near.corners[0]));
  };
  return heightOver(Wall) >= heightOver(Window);
}

void LatticeSampling::measure(
  const unsigned char* isInCell, const std::vector<unsigned char>& isInBody)
{
  constexpr float reach = schlieren::MediumSource::reach;
  const auto size = static_cast<std::size_t>(this->Lattice.size());
  this->Distances.resize(size);
  this->States.assign(size, InGas);
  this->forPoints(
    [&](const Index& at)
    {
      const std::size_t p = this->placeOf(at);
      const bool isWithinBody = !isInBody.empty() && isInBody[p];
      const float toWall = this->distanceTo(Wall, at), toWindow = this->distanceTo(Window, at);
      const float toMesh = std::max(std::min(toWall, toWindow), smallest);
      const float toBody = std::max(this->distanceTo(Body, at), smallest);
      this->Distances[p] =
        std::min(isInCell[p] ? toMesh : -toMesh, isWithinBody ? -toBody : toBody);
      if (isWithinBody)
      {
        this->States[p] = InWall;
      }
      else if (!isInCell[p])
      {
        const bool isNear = std::min(toWall, toWindow) < reach;
        this->States[p] = isNear ? (this->isWallNearer(at) ? InWall : InWindow) : Unknown;
      }
    });
}

/// Outside points that are known tell those beside them that are not.
void LatticeSampling::spread(std::vector<std::size_t>& known)
{
  const auto points = this->Lattice.points;
  for (std::size_t next = 0; next < known.size(); ++next)
  {
    const auto p = static_cast<int>(known[next]);
    const Index at{ p % points[0], p / points[0] % points[1], p / points[0] / points[1] };
    for (const auto& step : steps)
    {
      const Index beside{ at.i + step[0], at.j + step[1], at.k + step[2] };
      if (this->holds(beside) && this->States[this->placeOf(beside)] == Unknown)
      {
        this->States[this->placeOf(beside)] = this->States[known[next]];
        known.push_back(this->placeOf(beside));
      }
    }
  }
  known.clear();
}

void LatticeSampling::findKinds(const std::function<Place(const Point&)>& kindAt)
{
  if (std::find(this->States.begin(), this->States.end(), Unknown) == this->States.end())
  {
    return;
  }
  // No face is near, and gas is beside: what seems to be outside is a gap between cells.
  std::vector<std::size_t> known;
  this->forPoints(
    [&](const Index& at)
    {
      const std::size_t p = this->placeOf(at);
      for (const auto& step : steps)
      {
        const Index beside{ at.i + step[0], at.j + step[1], at.k + step[2] };
        if (this->States[p] == Unknown && this->holds(beside) &&
          this->States[this->placeOf(beside)] == InGas)
        {
          this->States[p] = InWindow;
          this->Distances[p] = -smallest;
        }
      }
    });
  this->forPoints(
    [&](const Index& at)
    {
      const std::size_t p = this->placeOf(at);
      if (this->States[p] != InGas && this->States[p] != Unknown && this->Distances[p] < -smallest)
      {
        known.push_back(p);
      }
    });
  this->spread(known);
  this->forPoints(
    [&](const Index& at)
    {
      const std::size_t p = this->placeOf(at);
      if (this->States[p] == Unknown)
      {
        const Point place{ this->Lattice.first[0] + at.i * this->Lattice.spacing[0],
          this->Lattice.first[1] + at.j * this->Lattice.spacing[1],
          this->Lattice.first[2] + at.k * this->Lattice.spacing[2] };
        this->States[p] = kindAt(place) == Place::Wall ? InWall : InWindow;
        known.push_back(p);
        this->spread(known);
      }
    });
}

/// Of a voxel whose corners `low` and low + (1, 1, 1) are: marks points so that a wall no longer separates
/// corners with gas.
void LatticeSampling::separate(const Index& low)
{
  struct Corner
  {
    Index at;
    Point place;
    std::size_t side; // the first corner that is on the same one
  };
  std::array<Corner, 8> corners;
  std::size_t count = 0;
  bool mayBeCrossed = false;
  Point firstNormal{ 0, 0, 0 };
  float nearest = diagonal;
  for (int c = 0; c < 8; ++c)
  {
    const Index at{ low.i + (c & 1), low.j + (c >> 1 & 1), low.k + (c >> 2) };
    if (this->States[this->placeOf(at)] != InGas)
    {
      continue;
    }
    const float distance = this->distanceToSolid(at);
    corners[count] = { at,
      { static_cast<double>(at.i), static_cast<double>(at.j), static_cast<double>(at.k) }, count };
    ++count;
    if (distance > diagonal)
    {
      continue;
    }
    // On one side of a wall that is about plane there is nothing to do.
    const Point normal = this->normalTowards(at);
    if (nearest + distance <= diagonal && dot(firstNormal, firstNormal) > 0)
    {
      mayBeCrossed = mayBeCrossed || dot(firstNormal, normal) < 0.9;
    }
    if (!(dot(firstNormal, firstNormal) > 0))
    {
      firstNormal = normal;
    }
    nearest = std::min(nearest, distance);
    if (distance <= onSurface)
    {
      corners[count - 1].place = corners[count - 1].place + double{ onSurface } * normal;
    }
  }
  if (!mayBeCrossed)
  {
    return;
  }

  // The walls that meet the voxel.
  constexpr double slack = 0.01;
  std::vector<const Near*> walls;
  for (const Kind kind : { Wall, Body })
  {
    for (const std::int32_t number : this->Numbers[kind])
    {
      const Near& near = this->Nearby[static_cast<std::size_t>(number)];
      const int lows[3] = { low.i, low.j, low.k };
      bool isNear = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const auto [least, most] =
          std::minmax({ near.corners[0][axis], near.corners[1][axis], near.corners[2][axis] });
        isNear = isNear && least <= lows[axis] + 1 + slack && most >= lows[axis] - slack;
      }
      if (isNear)
      {
        walls.push_back(&near);
      }
    }
  }
  if (walls.empty())
  {
    return;
  }
  double crossing[8][8]; // the mean of the first and the last one; negative: none
  for (std::size_t a = 0; a < count; ++a)
  {
    for (std::size_t b = a + 1; b < count; ++b)
    {
      double first = 2, last = -1;
      for (const Near* wall : walls)
      {
        const double share =
          crossingOf(wall->corners, wall->normal, corners[a].place, corners[b].place);
        if (share >= 0)
        {
          first = std::min(first, share);
          last = std::max(last, share);
        }
      }
      crossing[a][b] = last < 0 ? -1 : 0.5 * (first + last);
      if (last < 0)
      {
        const auto [one, other] = std::minmax({ corners[a].side, corners[b].side });
        for (std::size_t c = 0; c < count; ++c)
        {
          corners[c].side = corners[c].side == other ? one : corners[c].side;
        }
      }
    }
  }
  for (std::size_t a = 0; a < count; ++a)
  {
    for (std::size_t b = a + 1; b < count; ++b)
    {
      if (corners[a].side != corners[b].side)
      {
        if (crossing[a][b] < 0.5 + 1e-3)
        {
          this->Marked[this->placeOf(corners[a].at)] = 1;
        }
        if (crossing[a][b] > 0.5 - 1e-3)
        {
          this->Marked[this->placeOf(corners[b].at)] = 1;
        }
      }
    }
  }
}

/// Whether there is gas on two opposite sides of a point in a wall.
bool LatticeSampling::isThin(const Index& at) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto& step = steps[2 * axis];
    const Index one{ at.i + step[0], at.j + step[1], at.k + step[2] };
    const Index other{ at.i - step[0], at.j - step[1], at.k - step[2] };
    if (this->holds(one) && this->holds(other) && this->States[this->placeOf(one)] == InGas &&
      this->States[this->placeOf(other)] == InGas &&
      dot(this->normalTowards(one), this->normalTowards(other)) < -0.5)
    {
      return true;
    }
  }
  return false;
}

void LatticeSampling::thickenPlates()
{
  this->Marked.assign(this->States.size(), 0);
  const auto& points = this->Lattice.points;
  for (int k = 0; k + 1 < points[2]; ++k)
  {
    for (int j = 0; j + 1 < points[1]; ++j)
    {
      for (int i = 0; i + 1 < points[0]; ++i)
      {
        this->separate({ i, j, k });
      }
    }
  }
  this->forPoints(
    [&](const Index& at)
    {
      const std::size_t p = this->placeOf(at);
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

void LatticeSampling::run(const unsigned char* isInCell, const std::vector<unsigned char>& isInBody,
  const std::function<Place(const Point&)>& kindAt, Place* places, float* distances)
{
  this->measure(isInCell, isInBody);
  this->findKinds(kindAt);
  if (this->Fields[Wall] || this->Fields[Body])
  {
    this->thickenPlates();
  }
  for (std::size_t p = 0; p < this->States.size(); ++p)
  {
    places[p] = this->States[p] == InGas
      ? Place::Gas
      : (this->States[p] == InWall ? Place::Wall : Place::Window);
  }
  if (distances)
  {
    std::copy(this->Distances.begin(), this->Distances.end(), distances);
  }
}

} // namespace refractivity
