// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/OutsidePlaces.h"

#include "Input/CoincidentPoints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace filters
{

namespace
{

constexpr double mostPlaces = 96;  // along the longest side of the box
constexpr double leastPart = 0.01; // of a closed side, that flat faces in it cover
constexpr double mostOpen = 0.1;   // of the surface of a body within the hull
constexpr int finestTurn = 3;      // largest number in directions of the hull
constexpr double touching = 1e-6;  // of a spacing

} // namespace

OutsidePlaces::OutsidePlaces(const BoundaryFaces& faces)
  : AreOuter(faces.surface.size(), 0)
  , Hides(std::count(faces.hidesBehind.begin(), faces.hidesBehind.end(), 1) > 0)
{
  const PlaneSides sides(faces.surface);
  this->Tolerance = sides.tolerance();
  const std::vector<PlaneSide> largest = sides.largest();
  const bool isLayer = faces.extent == Extent::Layer;
  this->Axes = axesAlong(largest, isLayer);
  Triangles own = faces.surface;
  std::transform(own.points.begin(), own.points.end(), own.points.begin(),
    [&](const Point& point) { return this->turned(point); });
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->AreClosed[2 * axis] = sides.at(-1. * this->Axes[axis]).part > leastPart;
    this->AreClosed[2 * axis + 1] = sides.at(this->Axes[axis]).part > leastPart;
  }
  if (own.size() > 0)
  {
    this->layGrid(own, isLayer);
    this->markCrossed(own);
    this->markCrossed({ own.points, faces.ends });
    this->findGas(own);
    const Parts parts = this->partsOf(Kind::Passes);
    this->findBodies(parts);
    this->findHull(own, largest);
    this->findBodiesWithin();
    this->findOuter(own, faces.hidesBehind, sides, parts);
    this->freeFromHull();
  }
}

Point OutsidePlaces::turned(const Point& place) const
{
  return { dot(this->Axes[0], place), dot(this->Axes[1], place), dot(this->Axes[2], place) };
}

std::array<std::size_t, 3> OutsidePlaces::indexOf(std::size_t n) const
{
  return { n % this->Counts[0], n / this->Counts[0] % this->Counts[1],
    n / this->Counts[0] / this->Counts[1] };
}

Point OutsidePlaces::middleOf(std::size_t n) const
{
  const auto index = this->indexOf(n);
  Point middle;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    middle[axis] = this->Low[axis] + (static_cast<double>(index[axis]) + 0.5) * this->Spacing[axis];
  }
  return middle;
}

/// Returns a side of the hull that a place is beyond; null: none.
const PlaneSide* OutsidePlaces::hullBefore(const Point& own) const
{
  const auto found = std::find_if(this->Hull.begin(), this->Hull.end(),
    [&](const PlaneSide& side) { return dot(side.normal, own) > side.offset; });
  return found == this->Hull.end() ? nullptr : &*found;
}

/// Calls visit(side, neighbour) for each side of a place, as of AreClosed; at the box's own side the
/// neighbour is the place itself. Omits axes with one place.
template <class Visit>
void OutsidePlaces::forNeighbours(std::size_t n, const Visit& visit) const
{
  const auto index = this->indexOf(n);
  std::size_t step = 1;
  for (std::size_t axis = 0; axis < 3; step *= this->Counts[axis++])
  {
    if (this->isCut(axis))
    {
      visit(2 * axis, index[axis] > 0 ? n - step : n);
      visit(2 * axis + 1, index[axis] + 1 < this->Counts[axis] ? n + step : n);
    }
  }
}

void OutsidePlaces::layGrid(const Triangles& own, bool isLayer)
{
  this->Low = this->High = own.points[0];
  for (const Point& point : own.points)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], point[axis]);
      this->High[axis] = std::max(this->High[axis], point[axis]);
    }
  }
  const Point lengths = this->High - this->Low;
  const double longest = std::max({ lengths[0], lengths[1], isLayer ? 0 : lengths[2] });
  std::size_t all = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool isWhole = (isLayer && axis == 2) || !(lengths[axis] > 0);
    const double places = std::ceil(mostPlaces * lengths[axis] / longest - touching);
    this->Counts[axis] = isWhole ? 1 : static_cast<std::size_t>(std::max(1., places));
    this->Spacing[axis] = lengths[axis] / static_cast<double>(this->Counts[axis]);
    all *= this->Counts[axis];
  }
  this->Finest = longest / mostPlaces;
  this->Kinds.assign(all, Kind::Passes);
}

void OutsidePlaces::markCrossed(const Triangles& own)
{
  for (std::size_t t = 0; t < own.size(); ++t)
  {
    std::array<std::size_t, 3> first, last;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto [low, high] =
        std::minmax({ own.corner(t, 0)[axis], own.corner(t, 1)[axis], own.corner(t, 2)[axis] });
      first[axis] = this->indexAt(axis, low - touching * this->Spacing[axis]);
      last[axis] = this->indexAt(axis, high + touching * this->Spacing[axis]);
    }
    for (std::size_t k = first[2]; k <= last[2]; ++k)
    {
      for (std::size_t j = first[1]; j <= last[1]; ++j)
      {
        for (std::size_t i = first[0]; i <= last[0]; ++i)
        {
          const std::size_t n = (k * this->Counts[1] + j) * this->Counts[0] + i;
          const Point half = (0.5 + touching) * this->Spacing, middle = this->middleOf(n);
          if (this->Kinds[n] != Kind::Crossed && meets(own, t, { middle - half, middle + half }))
          {
            this->Kinds[n] = Kind::Crossed;
          }
        }
      }
    }
  }
}

OutsidePlaces::Parts OutsidePlaces::partsOf(Kind kind) const
{
  Classes classes(this->count());
  for (std::size_t n = 0; n < this->count(); ++n)
  {
    this->forNeighbours(n,
      [&](std::size_t, std::size_t beside)
      {
        if (beside < n && this->Kinds[n] == kind && this->Kinds[beside] == kind)
        {
          classes.join(beside, n);
        }
      });
  }
  Parts parts(this->count());
  for (std::size_t n = 0; n < parts.size(); ++n)
  {
    parts[n] = classes.rootOf(n);
  }
  return parts;
}

/// Finds parts that reach the sides of the box only where these are closed.
void OutsidePlaces::findBodies(const Parts& parts)
{
  std::vector<unsigned char> areOpen(this->count(), 0);
  for (std::size_t n = 0; n < this->count(); ++n)
  {
    this->forNeighbours(n,
      [&](std::size_t side, std::size_t beside)
      {
        if (beside == n && !this->AreClosed[side])
        {
          areOpen[parts[n]] = 1;
        }
      });
  }
  for (std::size_t n = 0; n < this->count(); ++n)
  {
    if (this->Kinds[n] == Kind::Passes && !areOpen[parts[n]])
    {
      this->Bodies += parts[n] == n ? 1 : 0;
      this->Kinds[n] = Kind::Body;
    }
  }
}

/// Finds planes that nearly bound the convex hull, and plane sides.
void OutsidePlaces::findHull(const Triangles& own, const std::vector<PlaneSide>& sides)
{
  for (PlaneSide side : sides)
  {
    if (side.part > leastPart && !isAlong(side.normal, this->Axes))
    {
      side.normal = this->turned(side.normal);
      this->Hull.push_back(side);
    }
  }
  const auto most = [&](std::size_t axis) { return this->isCut(axis) ? finestTurn : 0; };
  for (int i = -most(0); i <= most(0); ++i)
  {
    for (int j = -most(1); j <= most(1); ++j)
    {
      for (int k = -most(2); k <= most(2); ++k)
      {
        const Point normal =
          unit({ static_cast<double>(i), static_cast<double>(j), static_cast<double>(k) });
        double offset = -std::numeric_limits<double>::infinity(), corner = 0; // of mesh and box
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          corner += normal[axis] * (normal[axis] > 0 ? this->High : this->Low)[axis];
        }
        for (const Point& point : own.points)
        {
          offset = std::max(offset, dot(normal, point));
        }
        if (std::gcd(i, std::gcd(j, k)) == 1 && offset < corner - this->Tolerance)
        {
          this->Hull.push_back({ normal, offset, 0, 0 });
        }
      }
    }
  }
}

/// Finds further bodies within the convex hull: parts of whose surface little is open.
void OutsidePlaces::findBodiesWithin()
{
  std::vector<std::size_t> beyond;
  for (std::size_t n = 0; n < this->count(); ++n)
  {
    if (this->Kinds[n] == Kind::Passes && this->hullBefore(this->middleOf(n)))
    {
      beyond.push_back(n);
      this->Kinds[n] = Kind::BodyWithin; // as yet
    }
  }
  const Parts parts = this->partsOf(Kind::Passes);
  std::vector<double> surface(this->count(), 0), open(this->count(), 0);
  for (std::size_t n = 0; n < this->count(); ++n)
  {
    this->forNeighbours(n,
      [&](std::size_t side, std::size_t beside)
      {
        const bool isAtHull = this->Kinds[beside] == Kind::BodyWithin;
        const bool isOpen = isAtHull ? this->hullBefore(this->middleOf(beside))->part == 0
                                     : beside == n && !this->AreClosed[side];
        surface[parts[n]] +=
          isAtHull || beside == n || this->Kinds[beside] == Kind::Crossed ? 1 : 0;
        open[parts[n]] += isOpen ? 1 : 0;
      });
  }
  for (const std::size_t n : beyond)
  {
    this->Kinds[n] = Kind::Passes;
  }
  std::vector<std::size_t> found;
  for (std::size_t n = 0; n < this->count(); ++n)
  {
    const std::size_t part = parts[n];
    if (this->Kinds[n] == Kind::Passes && open[part] <= mostOpen * surface[part] &&
      !this->hullBefore(this->middleOf(n)))
    {
      this->Bodies += part == n ? 1 : 0;
      found.push_back(n);
    }
  }
  for (const std::size_t n : found)
  {
    this->Kinds[n] = Kind::BodyWithin;
  }
  // The hull cuts places whose middles are beyond it, and faces look one farther.
  for (int rim = 0; rim < 2; ++rim)
  {
    for (std::size_t i = 0, end = found.size(); i < end; ++i)
    {
      this->forNeighbours(found[i],
        [&](std::size_t, std::size_t beside)
        {
          if (this->Kinds[beside] == Kind::Passes)
          {
            this->Kinds[beside] = Kind::BodyWithin;
            found.push_back(beside);
          }
        });
    }
  }
}

/// Makes places of bodies that lie wholly within the hull independent of it: it need not be looked at in them any more.
void OutsidePlaces::freeFromHull()
{
  for (std::size_t n = 0; n < this->count(); ++n)
  {
    if (this->Kinds[n] == Kind::BodyWithin)
    {
      const Point middle = this->middleOf(n);
      const bool isFree = std::none_of(this->Hull.begin(), this->Hull.end(),
        [&](const PlaneSide& side)
        {
          double farthest = dot(side.normal, middle);
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            farthest += 0.5 * std::abs(side.normal[axis]) * this->Spacing[axis];
          }
          return farthest > side.offset - this->Tolerance;
        });
      this->Kinds[n] = isFree ? Kind::Body : Kind::BodyWithin;
    }
  }
}

std::size_t OutsidePlaces::numberAt(const Point& own) const
{
  std::size_t n = 0;
  for (std::size_t axis = 3; axis-- > 0;)
  {
    n = n * this->Counts[axis] + this->indexAt(axis, own[axis]);
  }
  return n;
}

std::size_t OutsidePlaces::indexAt(std::size_t axis, double x) const
{
  const double at = (x - this->Low[axis]) / this->Spacing[axis];
  const auto last = static_cast<double>(this->Counts[axis] - 1);
  return this->isCut(axis) ? static_cast<std::size_t>(std::clamp(at, 0., last)) : 0;
}

OutsidePlaces::Kind OutsidePlaces::kindAt(const Point& own) const
{
  const Kind kind = this->Kinds[this->numberAt(own)];
  return kind == Kind::BodyWithin && this->hullBefore(own) ? Kind::Passes : kind;
}

std::optional<OutsidePlaces::Place> OutsidePlaces::at(const Point& place) const
{
  const Kind kind = this->count() == 0 ? Kind::Crossed
    : !this->isBeyond(place)           ? this->kindAt(this->turned(place))
    : this->Hides                      ? Kind::Crossed
                                       : Kind::Passes;
  return kind == Kind::Body || kind == Kind::BodyWithin ? std::optional(Place::Wall)
    : kind == Kind::Passes                              ? std::optional(Place::Window)
                                                        : std::nullopt;
}

/// Returns whether a place is beyond a side of the box, and whether that is open.
std::array<bool, 2> OutsidePlaces::beyondSides(const Point& own, double tolerance) const
{
  bool isBeyond = false, isOpen = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool isBelow = own[axis] < this->Low[axis] - tolerance;
    const bool isAbove = own[axis] > this->High[axis] + tolerance;
    isBeyond = isBeyond || isBelow || isAbove;
    isOpen = isOpen || (isBelow && !this->AreClosed[2 * axis]) ||
      (isAbove && !this->AreClosed[2 * axis + 1]);
  }
  return { isBeyond, isOpen };
}

bool OutsidePlaces::isBeyond(const Point& place) const
{
  return this->count() > 0 && this->beyondSides(this->turned(place), this->Tolerance)[0];
}

} // namespace filters
