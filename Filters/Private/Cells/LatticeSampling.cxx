// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/LatticeSampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace filters
{

namespace
{

constexpr float smallest = 1.f / 4096; // minimum distance, which is never 0
constexpr float depthOfThin = 0.5f;
constexpr float onSurface =
  1e-3f; // distance to a surface below which points count to the side of its normal
constexpr float tie = 1e-3f;              // relative difference of distances to two faces
constexpr float squaredDiagonal = 3.001f; // of a voxel
constexpr float cosineOfPlane = 0.9f;
constexpr double besideVoxel = 0.01; // distance at which walls count as meeting it

constexpr int steps[6][3] = { { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, -1 },
  { 0, 0, 1 } };

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
  const std::vector<float> far(static_cast<std::size_t>(this->Lattice.points[0]), reach * reach);
  const std::vector<std::int32_t> none(far.size(), -1);
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
      for (int i = 0; i < this->Lattice.points[0]; ++i)
      {
        const std::size_t p = row + static_cast<std::size_t>(i);
        const float toWall = squared[Wall][i], toWindow = squared[Window][i],
                    toBody = squared[Body][i];
        const bool isBodyNearer = toBody < toWall;
        this->SquaredToSolid[p] = isBodyNearer ? toBody : toWall;
        this->NearestSolid[p] = nearest[isBodyNearer ? Body : Wall][i];

        const bool isWithinBody = !isInBody.empty() && isInBody[p];
        const float toMesh = std::max(std::sqrt(std::min(toWall, toWindow)), smallest);
        const float fromBody = std::max(std::sqrt(toBody), smallest);
        this->Distances[p] =
          std::min(isInCell[p] ? toMesh : -toMesh, isWithinBody ? -fromBody : fromBody);
        State state = isWithinBody ? InWall : InGas;
        if (!isWithinBody && !isInCell[p])
        {
          const std::int32_t wall = nearest[Wall][i], window = nearest[Window][i];
          const bool isTie =
            wall >= 0 && window >= 0 && std::abs(std::sqrt(toWall) - std::sqrt(toWindow)) < tie;
          // Accepts open bodies whose surface is where cells end, such as a hole in a mesh.
          const bool isBody = window >= 0 && nearest[Body][i] >= 0 &&
            std::abs(std::sqrt(toBody) - std::sqrt(toWindow)) < tie;
          const bool isWall = isBody ||
            (isTie ? this->isWallNearer({ i, j, k }, wall, window)
                   : wall >= 0 && toWall < toWindow);
          state = isWall ? InWall : (window >= 0 ? InWindow : Unknown);
        }
        this->States[p] = state;
      }
    }
  }
}

/// Finds gaps between cells: outside points that no face separates from gas beside them.
void LatticeSampling::findGaps()
{
  this->forPoints(
    [&](const Index& at)
    {
      const std::size_t p = this->numberOf(at);
      // Skips points so near to a face that rounding decides their side.
      if (this->States[p] == InGas || this->Distances[p] >= -1 - tie)
      {
        return;
      }
      this->forNeighbours(at,
        [&](const Index&, std::size_t beside)
        {
          if (this->States[beside] == InGas)
          {
            this->States[p] = InWindow;
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

/// Sets the unknown points of a box of indices.
void LatticeSampling::fill(const Index& low, const Index& high, State state)
{
  for (int k = low.k; k <= high.k; ++k)
  {
    for (int j = low.j; j <= high.j; ++j)
    {
      for (int i = low.i; i <= high.i; ++i)
      {
        unsigned char& of = this->States[this->numberOf({ i, j, k })];
        if (of == Unknown)
        {
          of = state;
        }
      }
    }
  }
}

/// Finds the kinds of unknown points of a box of indices: that of its corners where these are of one
/// kind, else part by part, because each test takes long.
void LatticeSampling::findKindsIn(
  const Index& low, const Index& high, const std::function<bool(const Index&)>& isWallAt)
{
  bool hasWall = false, hasWindow = false;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Index at{ (corner & 1) != 0 ? high.i : low.i, (corner & 2) != 0 ? high.j : low.j,
      (corner & 4) != 0 ? high.k : low.k };
    unsigned char& state = this->States[this->numberOf(at)];
    if (state == Unknown)
    {
      state = isWallAt(at) ? InWall : InWindow;
    }
    hasWall = hasWall || state == InWall;
    hasWindow = hasWindow || state == InWindow;
  }
  if (hasWall != hasWindow)
  {
    this->fill(low, high, hasWall ? InWall : InWindow);
    return;
  }
  const int lengths[3] = { high.i - low.i, high.j - low.j, high.k - low.k };
  const auto longest = std::max_element(lengths, lengths + 3) - lengths;
  if (lengths[longest] < 2)
  {
    return; // all are corners
  }
  Index below = high, above = low;
  int Index::*const along = longest == 0 ? &Index::i : (longest == 1 ? &Index::j : &Index::k);
  below.*along = above.*along = low.*along + lengths[longest] / 2;
  this->findKindsIn(low, below, isWallAt);
  this->findKindsIn(above, high, isWallAt);
}

void LatticeSampling::findKinds(const std::function<Place(const Point&)>& kindAt)
{
  this->findGaps();
  const auto hasAny = [&](State state)
  { return std::find(this->States.begin(), this->States.end(), state) != this->States.end(); };
  if (!hasAny(Unknown))
  {
    return;
  }
  const schlieren::Lattice& lattice = this->Lattice;
  const auto isWallAt = [&](const Index& at)
  {
    return kindAt({ lattice.first[0] + at.i * lattice.spacing[0],
             lattice.first[1] + at.j * lattice.spacing[1],
             lattice.first[2] + at.k * lattice.spacing[2] }) == Place::Wall;
  };
  const bool hasWall = hasAny(InWall), hasWindow = hasAny(InWindow);
  if (!hasWall || !hasWindow)
  {
    // Counts the corners, most of which are of one kind.
    int walls = hasWall ? 1 : 0, windows = hasWindow ? 1 : 0;
    for (int corner = 0; corner < 8 && !hasWindow; ++corner)
    {
      const Index at{ (corner & 1) != 0 ? lattice.points[0] - 1 : 0,
        (corner & 2) != 0 ? lattice.points[1] - 1 : 0,
        (corner & 4) != 0 ? lattice.points[2] - 1 : 0 };
      if (this->States[this->numberOf(at)] == Unknown)
      {
        ++(isWallAt(at) ? walls : windows);
      }
    }
    const Index last{ lattice.points[0] - 1, lattice.points[1] - 1, lattice.points[2] - 1 };
    if (walls == 0 || windows == 0)
    {
      this->fill({ 0, 0, 0 }, last, walls > 0 ? InWall : InWindow);
    }
    else
    {
      this->findKindsIn({ 0, 0, 0 }, last, isWallAt);
    }
    return;
  }
  std::vector<Index> known;
  this->forPoints(
    [&](const Index& at)
    {
      const std::size_t p = this->numberOf(at);
      if (this->States[p] != InGas && this->States[p] != Unknown && this->Distances[p] < -smallest)
      {
        known.push_back(at);
      }
    });
  this->spread(known);
  this->forPoints(
    [&](const Index& at)
    {
      const std::size_t p = this->numberOf(at);
      if (this->States[p] == Unknown)
      {
        this->States[p] = isWallAt(at) ? InWall : InWindow;
        known.push_back(at);
        this->spread(known);
      }
    });
}

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
    const auto& step = steps[2 * axis];
    const Index one{ at.i + step[0], at.j + step[1], at.k + step[2] };
    const Index other{ at.i - step[0], at.j - step[1], at.k - step[2] };
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

} // namespace filters
