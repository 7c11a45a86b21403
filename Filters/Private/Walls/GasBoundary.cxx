// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/GasBoundary.h"

#include "Walls/LatticeSampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace filters
{

GasBoundary::GasBoundary(
  BoundaryFaces faces, vtkDataObject* bodies, Outside outside, const WorkProgress& progress)
  : Faces(std::move(faces))
  , Tree(this->Faces.surface)
  , Walls(this->Faces.surface.size(), 0)
  , IsAuto(outside == Outside::Auto)
  , Far(outside == Outside::Blocks ? Place::Wall : Place::Window)
  , Bodies(bodies ? std::make_unique<BodySurfaces>(bodies) : nullptr)
{
  progress.reach(0.5);
  if (this->IsAuto || !this->Faces.origins.empty())
  {
    this->Outer.emplace(this->Faces);
  }
  for (std::size_t t = 0; t < this->Walls.size(); ++t)
  {
    const bool isWall = this->Faces.hidesBehind[t] || outside == Outside::Blocks ||
      (this->IsAuto && !this->Outer->isOuter(t));
    this->Walls[t] = isWall ? 1 : 0;
  }
  progress.reach(1);
}

double GasBoundary::ambient(const std::vector<vtkDataSet*>& leaves) const
{
  return this->ambient(valuesAt(this->Faces.origins, leaves));
}

double GasBoundary::ambient(const std::vector<double>& values) const
{
  const Triangles& surface = this->Faces.surface;
  std::vector<schlieren::WeightedValue> parts; // N, area
  for (const bool ofAll : { false, true })
  {
    for (std::size_t t = 0; t < surface.size(); ++t)
    {
      if (ofAll || (this->Outer && this->Outer->isOuter(t) && !this->Faces.hidesBehind[t]))
      {
        std::array<double, 3> ofCorners;
        std::transform(surface.corners[t].begin(), surface.corners[t].end(), ofCorners.begin(),
          [&](std::int32_t corner) { return values[static_cast<std::size_t>(corner)]; });
        std::sort(ofCorners.begin(), ofCorners.end()); // independent of their order
        parts.push_back(
          { (ofCorners[0] + ofCorners[1] + ofCorners[2]) / 3, norm(surface.normal(t)) });
      }
    }
    if (!parts.empty())
    {
      break;
    }
  }
  return schlieren::ambientOf(std::move(parts));
}

GasBoundary::Kinds GasBoundary::facesIn(const schlieren::Box& box) const
{
  Kinds kinds{ false, false };
  this->Tree.forTrianglesAt(box,
    [&](std::int32_t triangle)
    {
      const auto t = static_cast<std::size_t>(triangle);
      bool& has = this->Walls[t] ? kinds.wall : kinds.window;
      has = has || meets(this->Faces.surface, t, box);
    });
  if (this->Bodies && !kinds.wall)
  {
    this->Bodies->tree().forTrianglesAt(box,
      [&](std::int32_t triangle)
      {
        kinds.wall =
          kinds.wall || meets(this->Bodies->surface(), static_cast<std::size_t>(triangle), box);
      });
  }
  return kinds;
}

bool GasBoundary::areWallsFlatNear(const schlieren::Box& box) const
{
  constexpr double around = 1. / 8; // of the box: reach of distances in it
  constexpr double tilt = 1e-6, offset = 1e-5;
  schlieren::Box near = box;
  Point middle;
  double edge = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = box.high[axis] - box.low[axis];
    near.low[axis] -= around * length;
    near.high[axis] += around * length;
    middle[axis] = 0.5 * (box.low[axis] + box.high[axis]);
    edge = std::min(edge, length);
  }
  bool isFlat = true, isFirst = true;
  Point normal{};
  double distance = 0;
  const auto look = [&](const Triangles& surface, std::int32_t triangle, bool isWall)
  {
    const auto t = static_cast<std::size_t>(triangle);
    if (!isFlat || !meets(surface, t, near))
    {
      return;
    }
    const Point across = surface.normal(t);
    const Point own = (1 / norm(across)) * across;
    const double ownDistance = dot(own, surface.corner(t, 0) - middle);
    normal = isFirst ? own : normal;
    distance = isFirst ? ownDistance : distance;
    isFirst = false;
    isFlat =
      isWall && norm(own - normal) <= tilt && std::abs(ownDistance - distance) <= offset * edge;
  };
  this->Tree.forTrianglesAt(near,
    [&](std::int32_t triangle)
    { look(this->Faces.surface, triangle, this->Walls[static_cast<std::size_t>(triangle)] != 0); });
  if (this->Bodies)
  {
    this->Bodies->tree().forTrianglesAt(near,
      [&](std::int32_t triangle)
      { look(this->Bodies->surface(), triangle, this->Bodies->isOfClosed(triangle)); });
  }
  return isFlat;
}

std::array<Point, 9> GasBoundary::testedPlaces(
  const schlieren::Box& box, const schlieren::Box& bounds)
{
  std::array<Point, 9> places{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double low = std::clamp(box.low[axis], bounds.low[axis], bounds.high[axis]);
    const double high = std::clamp(box.high[axis], bounds.low[axis], bounds.high[axis]);
    places[0][axis] = 0.5 * (low + high);
    for (unsigned corner = 0; corner < 8; ++corner)
    {
      places[corner + 1][axis] = ((corner >> axis) & 1u) != 0 ? high : low;
    }
  }
  return places;
}

GasBoundary::Decided GasBoundary::decided() const
{
  const auto& hide = this->Faces.hidesBehind;
  const bool isAlone = !this->Bodies && std::count(hide.begin(), hide.end(), 1) == 0;
  return { this->IsAuto ? this->Outer->bodies() : 0, isAlone };
}

bool GasBoundary::hasBodiesIn(const schlieren::Box& box) const
{
  if (!this->Bodies)
  {
    return false;
  }
  bool has = this->Bodies->isInside(0.5 * (Point(box.low) + Point(box.high)));
  this->Bodies->tree().forTrianglesAt(box,
    [&](std::int32_t triangle)
    { has = has || meets(this->Bodies->surface(), static_cast<std::size_t>(triangle), box); });
  return has;
}

GasBoundary::Place GasBoundary::kindAt(const Point& place, bool isInCell) const
{
  if (this->Bodies && this->Bodies->isInside(place))
  {
    return Place::Wall;
  }
  if (isInCell)
  {
    return Place::Gas;
  }
  if (const std::optional<Place> kind = this->IsAuto ? this->Outer->at(place) : std::nullopt)
  {
    return *kind;
  }
  const int nearest = this->Tree.nearest(place);
  return nearest < 0                                 ? this->Far
    : this->Walls[static_cast<std::size_t>(nearest)] ? Place::Wall
                                                     : Place::Window;
}

void GasBoundary::sample(const schlieren::Lattice& lattice, const unsigned char* isInCell,
  Place* places, float* distances) const
{
  LatticeSampling sampling(lattice);
  sampling.addFaces(this->Faces.surface, this->Tree, this->Walls);
  std::vector<unsigned char> isInBody;
  if (this->Bodies)
  {
    const bool isNear = sampling.addBodies(this->Bodies->surface(), this->Bodies->tree());
    if (isNear)
    {
      this->Bodies->findInside(lattice, isInBody);
    }
    else if (this->Bodies->isInside(lattice.first))
    {
      isInBody.assign(static_cast<std::size_t>(lattice.size()), 1);
    }
  }
  sampling.run(
    isInCell, isInBody, [&](const Point& place) { return this->kindAt(place, false); },
    this->IsAuto ? &*this->Outer : nullptr, places, distances);
}

} // namespace filters
