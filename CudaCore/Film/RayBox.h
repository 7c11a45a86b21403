// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The light of single rays, each spread over a small box around where it lands.
#pragma once

#include "Film/CellLight.h"
#include "Film/NeighbourRays.h"
#include "Film/Splat.h"
#include "Math/HostDevice.h"
#include "Optics/Interferogram.h"

#include <cmath>
#include <cstdint>

namespace schlieren
{

/// Deposit, rowsAtOnce and isOfPhase: see Sheet.
template <int planes, class Deposit, int rowsAtOnce, bool isOfPhase = false>
class RayBox
{
public:
  using Ray = FilmRay<planes>;

  SCHLIEREN_HD RayBox(const FilmSize& film, Deposit& deposit)
    : film_(film)
    , deposit_(deposit)
  {
  }

  /// Spreads a ray's light over what becomes of a square of `side` pixels, at most one, around its start. How that is bent is
  /// known from its neighbours in the pass. The light is such that, added up over rays all over a pixel, what is curved has the
  /// right mean: less a 24th of the second difference each way, times the square of the side.
  SCHLIEREN_HD void add(const Ray& here, const Ray& left, const Ray& right, const Ray& below,
    const Ray& above, double side)
  {
    if (!here.arrives)
    {
      return;
    }
    const Change along = Change::of(left, here, right, 1, 0);
    const Change up = Change::of(below, here, above, 0, 1);
    std::int64_t light[planes];
    for (int plane = 0; plane < planes; ++plane)
    {
      const double second = along.second[plane] + up.second[plane];
      const double contrast =
        contrastOver(side * along.light[plane]) * contrastOver(side * up.light[plane]);
      light[plane] =
        film_.fixed(isOfPhase ? 0.5 + contrast * (fringeLight(here.light[plane]) - 0.5)
                              : limited(here.light[plane] - side * side / 24 * second));
    }
    constexpr double upright = 0.02; // pixels that one side of a box is higher than the other
    const double width = side * fabs(along.x), height = side * fabs(up.y);
    if (width <= 1 && height <= 1 && side * fabs(along.y) <= upright &&
      side * fabs(up.x) <= upright)
    {
      addUpright(here.x - 0.5 * width, here.y - 0.5 * height, width, height, light);
      return;
    }
    typename Polygons::Cell cell{ {}, {} };
    const double half = 0.5 * side;
    const auto corner = [&](double s, double t) -> FilmPoint {
      return { here.x + s * along.x + t * up.x, here.y + s * along.y + t * up.y };
    };
    cell.at[0] = corner(-half, -half);
    cell.at[1] = corner(half, -half);
    cell.at[2] = corner(half, half);
    cell.at[3] = corner(-half, half);
    addPolygon(cell, light);
  }

  /// Spreads light, in fixed point, evenly over a rectangle, no side of which is longer than a pixel.
  SCHLIEREN_HD void addUpright(
    double left, double low, double width, double height, const std::int64_t (&light)[planes])
  {
    const bool isNear = isOnFilm(left, low, film_.columns, film_.rows);
    const Footprint from = isNear ? footprintOf(left, low) : Footprint{ 0, 0, 0, 0 };
    // What of it is beyond the first pixel.
    const Footprint at = { from.column, from.row, beyond(from.right, width),
      beyond(from.high, height) };
    for (int plane = 0; plane < planes; ++plane)
    {
      deposit_.emitted(plane, light[plane]);
      if (isNear)
      {
        deposit_.block(plane, at.column, at.row, contributionsOf(at, light[plane]));
      }
      else
      {
        deposit_.outside(plane, light[plane]);
      }
    }
  }

private:
  using Polygons = CellLight<planes, Deposit, rowsAtOnce>;

  /// From pixel to pixel along an axis of the pass.
  struct Change
  {
    double x, y; ///< of the place on the film
    double light[planes], second[planes];

    /// Towards and from neighbours that belong to the ray; if neither does, that of undisturbed light.
    SCHLIEREN_HD static Change of(
      const Ray& before, const Ray& here, const Ray& after, double x, double y)
    {
      const bool hasBefore = areTogether(before, here), hasAfter = areTogether(here, after);
      const Ray& first = hasBefore ? before : here;
      const Ray& last = hasAfter ? after : here;
      const double per = hasBefore && hasAfter ? 0.5 : 1;
      const bool isKnown = hasBefore || hasAfter;
      Change change{ isKnown ? per * (last.x - first.x) : x, isKnown ? per * (last.y - first.y) : y,
        {}, {} };
      for (int plane = 0; plane < planes; ++plane)
      {
        change.light[plane] = per * (last.light[plane] - first.light[plane]);
        change.second[plane] =
          hasBefore && hasAfter ? secondDifference(before, here, after, plane) : 0;
      }
      return change;
    }
  };

  /// Of fringes, from one side of a square to the other. That of their mean, more by what the spread of it over the square takes
  /// away of fringes that are wider than that.
  SCHLIEREN_HD static double contrastOver(double turns)
  {
    const double mean = sincPi(turns);
    return mean * (2 - mean * mean);
  }

  SCHLIEREN_HD static double beyond(double from, double length)
  {
    const double part = (from - (1 - length)) / length;
    return part > 0 ? part : 0;
  }

  SCHLIEREN_NOINLINE void addPolygon(
    typename Polygons::Cell& cell, const std::int64_t (&light)[planes])
  {
    for (int plane = 0; plane < planes; ++plane)
    {
      for (double& atCorner : cell.light[plane])
      {
        atCorner = static_cast<double>(light[plane]) / film_.one;
      }
    }
    Polygons(film_, deposit_).add(cell);
  }

  const FilmSize film_;
  Deposit& deposit_;
};

} // namespace schlieren
