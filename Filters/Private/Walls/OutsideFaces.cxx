// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is beside faces.
#include "Walls/OutsidePlaces.h"

#include "Input/CoincidentPoints.h"

#include <algorithm>
#include <limits>

namespace filters
{

namespace
{

constexpr double lookingStep = 0.5; // beside faces, in spacings of the grid
constexpr int lookingSteps = 5;
constexpr std::size_t noPlace = std::numeric_limits<std::size_t>::max();
constexpr std::size_t beyondOpen = noPlace - 1, beyondClosed = noPlace - 2; // sides of the box

} // namespace

/// Returns the first place beside the middle of a face that no face crosses; none: noPlace, or
/// beyond the box.
std::size_t OutsidePlaces::lookFrom(
  const Triangles& own, std::size_t triangle, bool isOutward) const
{
  const Point middle =
    (1. / 3) * (own.corner(triangle, 0) + own.corner(triangle, 1) + own.corner(triangle, 2));
  const Point step = (isOutward ? -1 : 1) * lookingStep * this->Finest * unit(own.normal(triangle));
  for (int i = 1; i <= lookingSteps; ++i)
  {
    const Point place = middle + static_cast<double>(i) * step;
    const auto [isBeyond, isOpen] = this->beyondSides(place, 0);
    const std::size_t n = this->numberAt(place);
    if (isBeyond || this->Kinds[n] != Kind::Crossed)
    {
      return !isBeyond ? n : isOpen ? beyondOpen : beyondClosed;
    }
  }
  return noPlace;
}

/// Parts are gas into which more faces look than out of it.
void OutsidePlaces::findGas(const Triangles& own)
{
  const Parts parts = this->partsOf(Kind::Passes);
  std::vector<double> votes(this->count(), 0);
  for (std::size_t t = 0; t < own.size(); ++t)
  {
    for (const bool isOutward : { false, true })
    {
      const std::size_t n = this->lookFrom(own, t, isOutward);
      if (n < this->count())
      {
        votes[parts[n]] += (isOutward ? -1 : 1) * norm(own.normal(t));
      }
    }
  }
  for (std::size_t n = 0; n < this->count(); ++n)
  {
    const bool isGas = this->Kinds[n] == Kind::Passes && votes[parts[n]] >= 0;
    this->Kinds[n] = isGas ? Kind::Gas : this->Kinds[n];
  }
}

/// Looks at what is beside faces. Leaves parts to them beside which something is hidden. Where a
/// closed side or the hull is so near that no place is between, faces are as those in which they
/// continue smoothly.
void OutsidePlaces::findOuter(const Triangles& own, const std::vector<unsigned char>& hide,
  const PlaneSides& sides, const Parts& parts)
{
  constexpr int between = 0, outer = 1, wall = -1, atSide = 2;
  std::vector<int> found(own.size(), wall), votes(own.size(), 0);
  std::vector<unsigned char> areLeft(this->count(), 0);
  for (std::size_t t = 0; t < own.size(); ++t)
  {
    const Point &a = own.corner(t, 0), &b = own.corner(t, 1), &c = own.corner(t, 2);
    const std::size_t n = this->lookFrom(own, t, true);
    const Kind kind = n < this->count() ? this->Kinds[n] : Kind::Crossed;
    const bool isAtHull = kind == Kind::BodyWithin && this->hullBefore(this->middleOf(n));
    found[t] = n == beyondClosed || isAtHull    ? between
      : n == beyondOpen || kind == Kind::Passes ? outer
                                                : wall;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto [low, high] = std::minmax({ a[axis], b[axis], c[axis] });
      const bool isAtSide =
        high < this->Low[axis] + this->Tolerance || low > this->High[axis] - this->Tolerance;
      found[t] = isAtSide ? atSide : found[t];
    }
    if (n < this->count())
    {
      areLeft[parts[n]] |= hide[t];
    }
  }
  for (std::size_t n = 0; n < this->count(); ++n)
  {
    this->Kinds[n] = areLeft[parts[n]] ? Kind::Crossed : this->Kinds[n];
  }
  Classes classes(own.size());
  const auto forSmooth = [&](const auto& visit)
  {
    sides.forNeighbours(
      [&](std::size_t one, std::size_t other)
      {
        if (dot(unit(own.normal(one)), unit(own.normal(other))) > cosineOfGentle)
        {
          visit(one, other);
          visit(other, one);
        }
      });
  };
  forSmooth(
    [&](std::size_t one, std::size_t other)
    {
      if (found[one] == between && found[other] == between)
      {
        classes.join(one, other);
      }
    });
  forSmooth(
    [&](std::size_t one, std::size_t other)
    {
      if (found[one] == between && found[other] != atSide)
      {
        votes[classes.rootOf(one)] += found[other];
      }
    });
  for (std::size_t t = 0; t < own.size(); ++t)
  {
    const int vote = found[t] == between ? votes[classes.rootOf(t)] : found[t];
    this->AreOuter[t] = vote > 0 ? 1 : 0;
  }
}

} // namespace filters
