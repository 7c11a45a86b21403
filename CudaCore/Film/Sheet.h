// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// The ray-tube estimator. Four neighbouring rays of a pass have the light of one pixel between
// them; where they land it is spread evenly over the quadrilateral that they span, and each pixel gets what falls on it. So
// brightness is the ratio of areas, I/I0 = 1 / |det(dx'/dx)|, and folds add up.
#pragma once

#include "Film/CellLight.h"
#include "Film/NeighbourRays.h"
#include "Film/RayBox.h"
#include "Optics/Interferogram.h"

#include <cstdint>

namespace schlieren
{

/// Spreads the light between rays over a film's pixels. A `Deposit` takes it plane by plane:
///   emitted(plane, light)                 before it is divided;
///   pixel(plane, column, row, light)      on the film;
///   block(plane, column, row, parts)      of 2 x 2 pixels, some of which may be outside;
///   outside(plane, light)                 that falls on no pixel.
/// What is emitted arrives in pixels and outside, to the last bit. `rowsAtOnce`: of pixels that a polygon covers; the fewer,
/// the less memory. `isOfPhase`: rays have a phase instead of light, see FringePhase; light is made
/// of it where it is spread.
template <int planes, class Deposit, int rowsAtOnce = coverageTileSize, bool isOfPhase = false>
class Sheet
{
public:
  using Ray = FilmRay<planes>;

  SCHLIEREN_HD Sheet(const FilmSize& film, Deposit& deposit)
    : film_(film)
    , columns_(static_cast<double>(film.columns))
    , rows_(static_cast<double>(film.rows))
    , deposit_(deposit)
  {
  }

  /// The cell between four neighbouring rays. Where it is bent, it is added as four, with cubic interpolation
  /// between 4 x 4 rays: `around(i, j)` gives these, which may be unset where they do not arrive; rays 0 and 1
  /// are the cell's.
  template <class Around>
  SCHLIEREN_HD void addCell(const SheetRay<planes>& lowerLeft, const SheetRay<planes>& lowerRight,
    const SheetRay<planes>& upperLeft, const SheetRay<planes>& upperRight, const Around& around)
  {
    if (addPlain(lowerLeft, lowerRight, upperLeft, upperRight))
    {
      return;
    }
    const Halves halves = halvesOf(lowerLeft, lowerRight, upperLeft, upperRight, around);
    if (halves.areThere)
    {
      addQuarters(lowerLeft, lowerRight, upperLeft, upperRight, halves);
      return;
    }
    addCell(lowerLeft, lowerRight, upperLeft, upperRight);
  }

  /// The same in two steps, the first of which is all that most cells need: false if the second one has to follow,
  /// of parts 0 to 3.
  SCHLIEREN_HD bool addPlain(const SheetRay<planes>& lowerLeft, const SheetRay<planes>& lowerRight,
    const SheetRay<planes>& upperLeft, const SheetRay<planes>& upperRight)
  {
    return !isBent(lowerLeft, lowerRight, upperLeft, upperRight) &&
      addFlat(lowerLeft, lowerRight, upperLeft, upperRight);
  }
  template <class Around>
  SCHLIEREN_HD void addOther(int part, const SheetRay<planes>& lowerLeft,
    const SheetRay<planes>& lowerRight, const SheetRay<planes>& upperLeft,
    const SheetRay<planes>& upperRight, const Around& around)
  {
    const Halves halves = halvesOf(lowerLeft, lowerRight, upperLeft, upperRight, around);
    if (part > 0 && !halves.areThere)
    {
      return;
    }
    Ray corners[4] = { lowerLeft, lowerRight, upperLeft, upperRight };
    if (halves.areThere)
    {
      const bool isRight = part % 2 == 1, isUpper = part / 2 == 1;
      const auto [left, right, below, above, middle] =
        raysBetween(lowerLeft, lowerRight, upperLeft, upperRight, halves);
      corners[0] =
        either(isUpper, either(isRight, middle, left), either(isRight, below, lowerLeft));
      corners[1] =
        either(isUpper, either(isRight, right, middle), either(isRight, lowerRight, below));
      corners[2] =
        either(isUpper, either(isRight, above, upperLeft), either(isRight, middle, left));
      corners[3] =
        either(isUpper, either(isRight, upperRight, above), either(isRight, right, middle));
    }
    Sheet({ film_.columns, film_.rows, (halves.areThere ? 0.25 : 1) * film_.one }, deposit_)
      .addCell(corners[0], corners[1], corners[2], corners[3]);
  }

  /// The light between four neighbouring rays. Where some of them do not arrive, or do not cross the medium, the
  /// others give a quarter each, spread over the quarter of a cell on their side as if nothing were bent there:
  /// so even light is even up to where a shadow begins or the medium ends.
  SCHLIEREN_HD void addCell(
    const Ray& lowerLeft, const Ray& lowerRight, const Ray& upperLeft, const Ray& upperRight)
  {
    if (!addFlat(lowerLeft, lowerRight, upperLeft, upperRight))
    {
      addBent(lowerLeft, lowerRight, upperLeft, upperRight);
    }
  }

private:
  using Point = FilmPoint;
  using Polygons = CellLight<planes, Deposit, rowsAtOnce>;

  /// Places half-way between the rays of a cell, where it is added as four.
  struct Halves
  {
    bool areThere;
    Point left, right, below, above, middle;
  };

  /// A cell of which one ray lands in each of 2 x 2 pixels, as those of undisturbed light do: their common
  /// corner is inside of it and cuts it into four quadrilaterals. False if it is another.
  SCHLIEREN_HD bool addRegular(
    const Ray& lowerLeft, const Ray& lowerRight, const Ray& upperLeft, const Ray& upperRight)
  {
    // False for NaN. Also where no pixel is near.
    if (!(lowerLeft.x >= -1 && lowerLeft.x < columns_ && lowerLeft.y >= -1 && lowerLeft.y < rows_))
    {
      return false;
    }
    // Above -1, where cutting off the fraction of x + 1 is the floor.
    const std::int64_t column = static_cast<std::int64_t>(lowerLeft.x + 1) - 1;
    const std::int64_t row = static_cast<std::int64_t>(lowerLeft.y + 1) - 1;
    const double x = static_cast<double>(column + 1), y = static_cast<double>(row + 1);
    // How far the rays are from the pixels' common corner, into their pixel.
    const double x0 = x - lowerLeft.x, x1 = lowerRight.x - x;
    const double x2 = upperRight.x - x, x3 = x - upperLeft.x;
    const double y0 = y - lowerLeft.y, y1 = y - lowerRight.y;
    const double y2 = upperRight.y - y, y3 = upperLeft.y - y;
    const auto isWithin = [](double a) { return a >= 0 && a <= 1; };
    if (!(isWithin(x1) & isWithin(x2) & isWithin(x3) & isWithin(y1) & isWithin(y2) &
          isWithin(y3)) ||
      !(x0 + x1 > 0 && x2 + x3 > 0 && y0 + y3 > 0 && y1 + y2 > 0))
    {
      return false;
    }
    // Where its sides meet the pixels' borders: as fractions of the sides, and from the common corner.
    const double s0 = x0 / (x0 + x1), s1 = x3 / (x3 + x2); // of the lower and the upper side
    const double t0 = y0 / (y0 + y3), t1 = y1 / (y1 + y2); // of the left and the right side
    const double down = y0 + s0 * (y1 - y0), up = y3 + s1 * (y2 - y3);
    const double left = x0 + t0 * (x3 - x0), right = x1 + t1 * (x2 - x1);
    // Twice the areas.
    const double a0 = x0 * down + y0 * left, a1 = x1 * down + y1 * right;
    const double a2 = x2 * up + y2 * right, a3 = x3 * up + y3 * left;
    const double s = 0.5 * (s0 + s1), t = 0.5 * (t0 + t1);
    for (int plane = 0; plane < planes; ++plane)
    {
      const double l0 = lowerLeft.light[plane], l1 = lowerRight.light[plane];
      const double l2 = upperRight.light[plane], l3 = upperLeft.light[plane];
      // Bilinear between the rays: the mean over each part is that of its corners.
      const double lower = l0 + s0 * (l1 - l0), upper = l3 + s1 * (l2 - l3);
      const double sideLeft = l0 + t0 * (l3 - l0), sideRight = l1 + t1 * (l2 - l1);
      const double lowerMiddle = l0 + s * (l1 - l0), upperMiddle = l3 + s * (l2 - l3);
      const double middle = lowerMiddle + t * (upperMiddle - lowerMiddle);
      const double w0 = a0 * lightOfPart(l0, lower, sideLeft, middle);
      const double w1 = a1 * lightOfPart(l1, lower, sideRight, middle);
      const double w2 = a2 * lightOfPart(l2, upper, sideRight, middle);
      const double w3 = a3 * lightOfPart(l3, upper, sideLeft, middle);
      const double sum = (w0 + w2) + (w1 + w3);
      const std::int64_t whole = film_.fixed(
        isOfPhase ? 0.25 * sum / ((a0 + a2) + (a1 + a3)) : 0.25 * ((l0 + l2) + (l1 + l3)));
      const double scale = sum > 0 ? static_cast<double>(whole) / sum : 0;
      const auto second = static_cast<std::int64_t>(w1 * scale);
      const auto third = static_cast<std::int64_t>(w2 * scale);
      const auto fourth = static_cast<std::int64_t>(w3 * scale);
      deposit_.emitted(plane, whole);
      deposit_.block(plane, column, row,
        Contributions{ whole - second - third - fourth, second, fourth, third });
    }
    return true;
  }

  /// Four times the mean light of a part of a cell with a corner, one beside it, one above or below it, and one opposite.
  SCHLIEREN_HD static double lightOfPart(double corner, double beside, double over, double opposite)
  {
    const double sum = corner + beside + over + opposite;
    if constexpr (isOfPhase)
    {
      return 4 *
        fringeLight(0.25 * sum, 0.5 * ((beside - corner) + (opposite - over)),
          0.5 * ((over - corner) + (opposite - beside)));
    }
    return sum;
  }

  SCHLIEREN_HD static bool isBent(const SheetRay<planes>& lowerLeft,
    const SheetRay<planes>& lowerRight, const SheetRay<planes>& upperLeft,
    const SheetRay<planes>& upperRight)
  {
    constexpr double straight = 0.02; ///< pixels
    constexpr double tangled =
      8; ///< where rays are too far from each other to know what is between
    const double bend =
      maximum(maximum(lowerLeft.bend, lowerRight.bend), maximum(upperLeft.bend, upperRight.bend));
    return bend > straight && bend < tangled;
  }

  /// A cell that is regular, or not all of whose rays belong together. False if it is another.
  SCHLIEREN_HD bool addFlat(
    const Ray& lowerLeft, const Ray& lowerRight, const Ray& upperLeft, const Ray& upperRight)
  {
    if (areTogether(lowerLeft, lowerRight) && areTogether(lowerLeft, upperLeft) &&
      areTogether(lowerLeft, upperRight))
    {
      return addRegular(lowerLeft, lowerRight, upperLeft, upperRight);
    }
    addQuarter(lowerLeft, 0, 0);
    addQuarter(lowerRight, -0.5, 0);
    addQuarter(upperLeft, 0, -0.5);
    addQuarter(upperRight, -0.5, -0.5);
    return true;
  }

  /// There are none of a cell that is not bent, or if not all rays belong together.
  template <class Around>
  SCHLIEREN_NOINLINE static Halves halvesOf(const SheetRay<planes>& lowerLeft,
    const SheetRay<planes>& lowerRight, const SheetRay<planes>& upperLeft,
    const SheetRay<planes>& upperRight, const Around& around)
  {
    Halves halves{};
    if (!isBent(lowerLeft, lowerRight, upperLeft, upperRight))
    {
      return halves;
    }
    Point at[4][4];
    Point rows[4]; // half-way between rays 0 and 1 of each row
    for (int j = 0; j < 4; ++j)
    {
      for (int i = 0; i < 4; ++i)
      {
        const Ray& ray = around(i - 1, j - 1);
        if (!areTogether(lowerLeft, ray))
        {
          return halves;
        }
        at[j][i] = { ray.x, ray.y };
      }
      rows[j] = halfWay(at[j][0], at[j][1], at[j][2], at[j][3]);
    }
    return { true, halfWay(at[0][1], at[1][1], at[2][1], at[3][1]),
      halfWay(at[0][2], at[1][2], at[2][2], at[3][2]), rows[1], rows[2],
      halfWay(rows[0], rows[1], rows[2], rows[3]) };
  }

  /// All that addOther does of a cell that has halves.
  SCHLIEREN_NOINLINE void addQuarters(const Ray& lowerLeft, const Ray& lowerRight,
    const Ray& upperLeft, const Ray& upperRight, const Halves& halves)
  {
    const auto [left, right, below, above, middle] =
      raysBetween(lowerLeft, lowerRight, upperLeft, upperRight, halves);
    const Ray rays[3][3] = { { lowerLeft, below, lowerRight }, { left, middle, right },
      { upperLeft, above, upperRight } };
    Sheet quarter({ film_.columns, film_.rows, 0.25 * film_.one }, deposit_);
    for (int n = 0; n < 4; ++n)
    {
      const int i = n % 2, j = n / 2;
      quarter.addCell(rays[j][i], rays[j][i + 1], rays[j + 1][i], rays[j + 1][i + 1]);
    }
  }

  /// Chooses one of two rays that belong together, number by number: a choice between structures would have them in memory.
  SCHLIEREN_HD static Ray either(bool isFirst, const Ray& first, const Ray& second)
  {
    Ray ray = first;
    ray.x = isFirst ? first.x : second.x;
    ray.y = isFirst ? first.y : second.y;
    for (int plane = 0; plane < planes; ++plane)
    {
      ray.light[plane] = isFirst ? first.light[plane] : second.light[plane];
    }
    return ray;
  }

  /// The middle of a cubic through four points (Catmull & Rom 1974).
  SCHLIEREN_HD static Point halfWay(
    const Point& before, const Point& a, const Point& b, const Point& after)
  {
    return { (9 * (a.x + b.x) - (before.x + after.x)) / 16,
      (9 * (a.y + b.y) - (before.y + after.y)) / 16 };
  }

  struct RaysBetween
  {
    Ray left, right, below, above, middle;
  };
  SCHLIEREN_HD static RaysBetween raysBetween(const Ray& lowerLeft, const Ray& lowerRight,
    const Ray& upperLeft, const Ray& upperRight, const Halves& halves)
  {
    const Ray left = between(lowerLeft, upperLeft, halves.left);
    const Ray right = between(lowerRight, upperRight, halves.right);
    return { left, right, between(lowerLeft, lowerRight, halves.below),
      between(upperLeft, upperRight, halves.above), between(left, right, halves.middle) };
  }
  SCHLIEREN_HD static Ray between(const Ray& a, const Ray& b, const Point& at)
  {
    Ray ray;
    ray.x = at.x;
    ray.y = at.y;
    ray.arrives = true;
    ray.crossed = a.crossed;
    for (int plane = 0; plane < planes; ++plane)
    {
      ray.light[plane] = 0.5 * (a.light[plane] + b.light[plane]);
    }
    return ray;
  }

  /// A square of half a pixel, whose lower left corner is at (right, up) from where the ray lands.
  SCHLIEREN_HD void addQuarter(const Ray& ray, double right, double up)
  {
    if (!ray.arrives)
    {
      return;
    }
    std::int64_t light[planes];
    for (int plane = 0; plane < planes; ++plane)
    {
      light[plane] =
        film_.fixed(0.25 * (isOfPhase ? fringeLight(ray.light[plane]) : ray.light[plane]));
    }
    RayBox<planes, Deposit, rowsAtOnce>(film_, deposit_)
      .addUpright(ray.x + right, ray.y + up, 0.5, 0.5, light);
  }

  /// Any other cell.
  SCHLIEREN_NOINLINE void addBent(
    const Ray& lowerLeft, const Ray& lowerRight, const Ray& upperLeft, const Ray& upperRight)
  {
    Polygons(film_, deposit_).add(cellOf(lowerLeft, lowerRight, upperLeft, upperRight));
  }

  SCHLIEREN_HD static typename Polygons::Cell cellOf(
    const Ray& lowerLeft, const Ray& lowerRight, const Ray& upperLeft, const Ray& upperRight)
  {
    typename Polygons::Cell cell = { { { lowerLeft.x, lowerLeft.y }, { lowerRight.x, lowerRight.y },
                                       { upperRight.x, upperRight.y },
                                       { upperLeft.x, upperLeft.y } },
      {} };
    for (int plane = 0; plane < planes; ++plane)
    {
      cell.light[plane][0] = lowerLeft.light[plane];
      cell.light[plane][1] = lowerRight.light[plane];
      cell.light[plane][2] = upperRight.light[plane];
      cell.light[plane][3] = upperLeft.light[plane];
      if constexpr (isOfPhase)
      {
        makeLight(cell.light[plane]);
      }
    }
    return cell;
  }

  /// Replaces the corners' phases by light whose mean is that of the cell.
  SCHLIEREN_HD static void makeLight(double (&corners)[4])
  {
    const double mean = 0.25 * lightOfPart(corners[0], corners[1], corners[3], corners[2]);
    double sum = 0;
    for (double& corner : corners)
    {
      corner = fringeLight(corner);
      sum += corner;
    }
    const double missing = mean - 0.25 * sum;
    for (double& corner : corners)
    {
      corner = limited(corner + missing);
    }
  }

  const FilmSize film_;
  const double columns_, rows_;
  Deposit& deposit_;
};

} // namespace schlieren
