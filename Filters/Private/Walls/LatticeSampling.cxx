// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/LatticeSampling.h"

#include <algorithm>
#include <cmath>

namespace filters
{

namespace
{

constexpr float smallest = 1.f / 4096; // minimum distance, which is never 0
constexpr float tie = 1e-3f;           // relative difference of distances to two faces

constexpr int steps[6][3] = { { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, -1 },
  { 0, 0, 1 } };

} // namespace

LatticeSampling::LatticeSampling(const schlieren::Lattice& lattice)
  : Lattice(lattice)
  , Metric(lattice)
{
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

template <class Visit>
void LatticeSampling::forNeighbours(const Index& at, const Visit& visit) const
{
  for (const auto& step : steps)
  {
    const Index beside{ at.i + step[0], at.j + step[1], at.k + step[2] };
    if (this->holds(beside))
    {
      visit(beside, this->numberOf(beside));
    }
  }
}

/// Decides between a wall and a window at equal distances, at a common edge: the one whose plane is
/// farther away faces the point more.
bool LatticeSampling::isWallNearer(const Index& at, std::int32_t wall, std::int32_t window) const
{
  const auto heightOver = [&](std::int32_t number)
  {
    const Near& near = this->Nearby[static_cast<std::size_t>(number)];
    return std::abs(dot(near.normal, placeOf(at) - near.corners[0]));
  };
  return heightOver(wall) >= heightOver(window);
}

void LatticeSampling::measure(
  const unsigned char* isInCell, const std::vector<unsigned char>& isInBody)
{
  constexpr float reach = schlieren::MediumSource::reach;
  const auto size = static_cast<std::size_t>(this->Lattice.size());
  this->Distances.resize(size);
  this->States.resize(size);
  this->SquaredToSolid.resize(size);
  this->NearestSolid.resize(size);
  const auto width = static_cast<std::size_t>(this->Lattice.points[0]);
  const std::vector<float> far(width, reach * reach);
  std::vector<std::int32_t> none;
  none.resize(width, -1); // made with its size, GCC 14 warns of its end
  const std::vector<unsigned char> outsideOfBodies(isInBody.empty() ? width : 0, 0);
  for (int k = 0; k < this->Lattice.points[2]; ++k)
  {
    for (int j = 0; j < this->Lattice.points[1]; ++j)
    {
      const float* squared[3];
      const std::int32_t* nearest[3];
      for (const Kind kind : { Wall, Window, Body })
      {
        const LatticeDistances* field = this->Fields[kind].get();
        squared[kind] = field ? field->squaredInRow(j, k) : far.data();
        nearest[kind] = field ? field->nearestInRow(j, k) : none.data();
      }
      const std::size_t row = this->numberOf({ 0, j, k });
      const unsigned char* inCell = isInCell + row;
      const unsigned char* inBody =
        isInBody.empty() ? outsideOfBodies.data() : isInBody.data() + row;
      for (std::size_t i = 0; i < width; ++i)
      {
        const float toWall = squared[Wall][i], toWindow = squared[Window][i],
                    toBody = squared[Body][i];
        const bool isBodyNearer = toBody < toWall;
        this->SquaredToSolid[row + i] = isBodyNearer ? toBody : toWall;
        this->NearestSolid[row + i] = isBodyNearer ? nearest[Body][i] : nearest[Wall][i];
        const float toMesh = std::max(std::sqrt(std::min(toWall, toWindow)), smallest);
        const float fromBody = std::max(std::sqrt(toBody), smallest);
        this->Distances[row + i] =
          std::min(inCell[i] ? toMesh : -toMesh, inBody[i] ? -fromBody : fromBody);
        this->States[row + i] = inBody[i] ? InWall : InGas;
      }
      for (std::size_t i = 0; i < width; ++i)
      {
        if (inBody[i] || inCell[i])
        {
          continue;
        }
        const float toWall = squared[Wall][i], toWindow = squared[Window][i];
        const std::int32_t wall = nearest[Wall][i], window = nearest[Window][i];
        const bool isTie =
          wall >= 0 && window >= 0 && std::abs(std::sqrt(toWall) - std::sqrt(toWindow)) < tie;
        // Accepts open bodies whose surface is where cells end, such as a hole in a mesh.
        const bool isBody = window >= 0 && nearest[Body][i] >= 0 &&
          std::abs(std::sqrt(squared[Body][i]) - std::sqrt(toWindow)) < tie;
        const bool isWall = isBody ||
          (isTie ? this->isWallNearer({ static_cast<int>(i), j, k }, wall, window)
                 : wall >= 0 && toWall < toWindow);
        this->States[row + i] = isWall ? InWall : (window >= 0 ? InWindow : Unknown);
      }
    }
  }
}

/// Finds gaps between cells: outside points that no face separates from gas beside them.
void LatticeSampling::findGaps()
{
  unsigned char* const states = this->States.data();
  const float* const distances = this->Distances.data();
  // Skips points so near to a face that rounding decides their side.
  this->forPoints([=](std::size_t p) { return states[p] != InGas && distances[p] < -1 - tie; },
    [&](const Index& at, std::size_t p)
    {
      this->forNeighbours(at,
        [&](const Index&, std::size_t beside)
        {
          if (states[beside] == InGas)
          {
            states[p] = InWindow;
            this->Distances[p] = -smallest;
          }
        });
    });
}

/// Copies known kinds of outside points to unknown neighbours.
void LatticeSampling::spread(std::vector<Index>& known)
{
  for (std::size_t next = 0; next < known.size(); ++next)
  {
    const unsigned char state = this->States[this->numberOf(known[next])];
    this->forNeighbours(Index(known[next]),
      [&](const Index& beside, std::size_t number)
      {
        if (this->States[number] == Unknown)
        {
          this->States[number] = state;
          known.push_back(beside);
        }
      });
  }
  known.clear();
}

void LatticeSampling::findKinds(
  const std::function<Place(const Point&)>& kindAt, const OutsidePlaces* decided)
{
  this->findGaps();
  const auto pointAt = [&](const Index& at)
  {
    const schlieren::Lattice& lattice = this->Lattice;
    return Point{ lattice.first[0] + at.i * lattice.spacing[0],
      lattice.first[1] + at.j * lattice.spacing[1], lattice.first[2] + at.k * lattice.spacing[2] };
  };
  const auto stateOf = [](Place place) { return place == Place::Wall ? InWall : InWindow; };
  unsigned char* const states = this->States.data();
  const float* const distances = this->Distances.data();
  const auto isUnknown = [=](std::size_t p) { return states[p] == Unknown; };
  bool areLeft = false;
  this->forPoints(isUnknown,
    [&](const Index& at, std::size_t p)
    {
      const std::optional<Place> place = decided ? decided->at(pointAt(at)) : std::nullopt;
      states[p] = place ? stateOf(*place) : Unknown;
      areLeft = areLeft || !place;
    });
  if (!areLeft)
  {
    return;
  }
  std::vector<Index> known;
  this->forPoints([=](std::size_t p)
    { return states[p] != InGas && states[p] != Unknown && distances[p] < -smallest; },
    [&](const Index& at, std::size_t)
    {
      bool isBeside = false;
      this->forNeighbours(
        at, [&](const Index&, std::size_t beside) { isBeside = isBeside || isUnknown(beside); });
      // Beyond the mesh no face divides what is beside a body from the body.
      if (isBeside && !(decided && decided->isBeyond(pointAt(at))))
      {
        known.push_back(at);
      }
    });
  this->spread(known);
  this->forPoints(isUnknown,
    [&](const Index& at, std::size_t p)
    {
      states[p] = stateOf(kindAt(pointAt(at)));
      known.push_back(at);
      this->spread(known);
    });
}

void LatticeSampling::run(const unsigned char* isInCell, const std::vector<unsigned char>& isInBody,
  const std::function<Place(const Point&)>& kindAt, const OutsidePlaces* decided, Place* places,
  float* distances)
{
  this->measure(isInCell, isInBody);
  this->findKinds(kindAt, decided);
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

} // namespace filters
