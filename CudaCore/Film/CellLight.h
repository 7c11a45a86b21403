// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Spreads the light of a quadrilateral over the pixels that it covers: as polygons, each pixel getting what it covers
// of them, or as points.
#pragma once

#include "Film/Corners.h"
#include "Film/Coverage.h"
#include "Film/Splat.h"

#include <cmath>
#include <cstdint>

namespace schlieren
{

/// The light between four rays. Deposit and rowsAtOnce: see Sheet.
template <int planes, class Deposit, int rowsAtOnce>
class CellLight
{
public:
  using Point = FilmPoint;
  using Box = FilmBox;

  /// Counterclockwise from the lower left.
  struct Cell
  {
    Point at[4];
    double light[planes][4];

    SCHLIEREN_HD double mean(int plane) const
    {
      return 0.25 * ((light[plane][0] + light[plane][2]) + (light[plane][1] + light[plane][3]));
    }
    /// Makes the second corner the first one.
    SCHLIEREN_HD void turn()
    {
      turnCorners(at);
      for (double(&corners)[4] : light)
      {
        turnCorners(corners);
      }
    }
  };

  SCHLIEREN_HD CellLight(const FilmSize& film, Deposit& deposit)
    : film_(film)
    , columns_(static_cast<double>(film.columns))
    , rows_(static_cast<double>(film.rows))
    , deposit_(deposit)
  {
  }

  SCHLIEREN_HD void add(const Cell& cell)
  {
    constexpr double maxPixels = 4096; // looked at one by one, for one cell
    constexpr double maxSize = 1e9;
    Rest rest{ {}, -1, -1 };
    for (int plane = 0; plane < planes; ++plane)
    {
      rest.light[plane] = film_.fixed(cell.mean(plane));
      deposit_.emitted(plane, rest.light[plane]);
    }
    double size = 0; // not finite where a corner is not
    for (const Point& at : cell.at)
    {
      size += fabs(at.x) + fabs(at.y);
    }
    const Box box = Box::around(cell.at);
    if (size < 1e300 && isNear(box))
    {
      const double columns = floor(minimum(box.right, columns_)) - floor(maximum(box.left, 0.)) + 1;
      const double rows = floor(minimum(box.high, rows_)) - floor(maximum(box.low, 0.)) + 1;
      if (columns * rows == 1 && isInside(box))
      {
        rest.column = static_cast<std::int64_t>(box.left);
        rest.row = static_cast<std::int64_t>(box.low);
      }
      else
      {
        addShape(cell, columns * rows > maxPixels || size > maxSize, rest);
      }
    }
    for (int plane = 0; plane < planes; ++plane)
    {
      give(plane, rest.light[plane], rest.column >= 0, rest);
    }
  }

private:
  /// Light in a polygon: of each plane mean + perX (x - centre.x) + perY (y - centre.y).
  struct Light
  {
    Point centre;
    double mean[planes], perX[planes], perY[planes];
  };

  /// Clockwise (its area is negative then) or counterclockwise.
  struct Polygon
  {
    Point at[4]; ///< of a triangle, the last two are one
    double area;
    double fraction; ///< of the cell's rays that it holds
  };

  /// What is still to be given away of a cell's light, and where rounding's residue goes.
  struct Rest
  {
    std::int64_t light[planes];
    std::int64_t column, row; ///< a pixel that got light; column < 0: none
  };

  /// To the pixel that got light last, or outside of the film.
  SCHLIEREN_HD void give(int plane, std::int64_t light, bool isOnFilm, Rest& rest)
  {
    if (isOnFilm)
    {
      deposit_.pixel(plane, rest.column, rest.row, light);
    }
    else
    {
      deposit_.outside(plane, light);
    }
    rest.light[plane] -= light;
  }

  SCHLIEREN_HD bool isNear(const Box& box) const
  {
    return box.right >= 0 && box.left < columns_ && box.high >= 0 && box.low < rows_;
  }
  SCHLIEREN_HD bool isInside(const Box& box) const
  {
    return box.left >= 0 && box.right < columns_ && box.low >= 0 && box.high < rows_;
  }

  /// A cell as one polygon, or, where it is none, as four triangles around its middle, each with a quarter of the
  /// rays, wherever they lie over each other; or, where it is too large or has no area, as points.
  SCHLIEREN_HD void addShape(Cell cell, bool isTooLarge, Rest& rest)
  {
    Light light{};
    double area = 0;
    const bool isConvex = !isTooLarge && findConvex(cell, area, light);
    const Point middle = { 0.25 * ((cell.at[0].x + cell.at[2].x) + (cell.at[1].x + cell.at[3].x)),
      0.25 * ((cell.at[0].y + cell.at[2].y) + (cell.at[1].y + cell.at[3].y)) };
    const bool isFolded = !isTooLarge && !isConvex && isWide(areaAround(cell, middle), cell.at);
    for (int n = 0; n < (isFolded ? 4 : 1); ++n)
    {
      Cell part = cell;
      bool isPolygon = isConvex;
      if (isFolded)
      {
        part.at[2] = part.at[3] = middle;
        findTriangle(cell, middle, area, light);
        isPolygon = isWide(area, part.at);
        for (int plane = 0; plane < planes; ++plane)
        {
          for (double& atCorner : part.light[plane])
          {
            atCorner = light.mean[plane];
          }
        }
        cell.turn();
      }
      if (isPolygon)
      {
        addPolygon(part.at, area, isFolded ? 0.25 : 1, light, rest);
      }
      else
      {
        addPoints(part, isFolded ? 0.25 : 1, rest);
      }
    }
  }

  /// Twice the area of the triangles between a cell's sides and a point, each counted as positive.
  SCHLIEREN_HD static double areaAround(const Cell& cell, const Point& middle)
  {
    return fabs(cross(cell.at[0], cell.at[1], middle)) +
      fabs(cross(cell.at[1], cell.at[2], middle)) + fabs(cross(cell.at[2], cell.at[3], middle)) +
      fabs(cross(cell.at[3], cell.at[0], middle));
  }

  /// False if the cell is not convex, has hardly any area, or if light that varies linearly in it would be
  /// negative somewhere.
  SCHLIEREN_HD static bool findConvex(const Cell& cell, double& area, Light& light)
  {
    const Point(&at)[4] = cell.at;
    const double firstX = at[2].x - at[0].x, firstY = at[2].y - at[0].y; // diagonals
    const double secondX = at[3].x - at[1].x, secondY = at[3].y - at[1].y;
    area = 0.5 * (firstX * secondY - firstY * secondX);
    if (!isWide(area, at))
    {
      return false;
    }
    bool isConvex = true;
    forEachCorner(at,
      [&](const Point& a, const Point& b, const Point& c)
      {
        const double turn = cross(a, b, c);
        isConvex = isConvex && !(area > 0 ? turn < 0 : turn > 0);
      });
    if (!isConvex)
    {
      return false;
    }
    // That of two triangles.
    const double fraction = 0.5 * cross(at[0], at[1], at[2]) / area;
    light.centre = { (at[0].x + at[2].x + fraction * at[1].x + (1 - fraction) * at[3].x) / 3,
      (at[0].y + at[2].y + fraction * at[1].y + (1 - fraction) * at[3].y) / 3 };
    // From the middle of a side to that of the opposite one: s to the right, t up; s x t is the area.
    const double sx = 0.5 * (firstX - secondX), sy = 0.5 * (firstY - secondY);
    const double tx = 0.5 * (firstX + secondX), ty = 0.5 * (firstY + secondY);
    for (int plane = 0; plane < planes; ++plane)
    {
      const double first = cell.light[plane][2] - cell.light[plane][0];
      const double second = cell.light[plane][3] - cell.light[plane][1];
      const double alongS = 0.5 * (first - second), alongT = 0.5 * (first + second);
      light.mean[plane] = cell.mean(plane);
      light.perX[plane] = (alongS * ty - alongT * sy) / area;
      light.perY[plane] = (alongT * sx - alongS * tx) / area;
      for (const Point& corner : at)
      {
        if (light.mean[plane] + light.perX[plane] * (corner.x - light.centre.x) +
            light.perY[plane] * (corner.y - light.centre.y) <
          0)
        {
          return false;
        }
      }
    }
    return true;
  }

  /// The triangle between a cell's first two corners and its middle.
  SCHLIEREN_HD static void findTriangle(
    const Cell& cell, const Point& middle, double& area, Light& light)
  {
    area = 0.5 * cross(cell.at[0], cell.at[1], middle);
    const double ax = cell.at[0].x - middle.x, ay = cell.at[0].y - middle.y;
    const double bx = cell.at[1].x - middle.x, by = cell.at[1].y - middle.y;
    light.centre = { middle.x + (ax + bx) / 3, middle.y + (ay + by) / 3 };
    for (int plane = 0; plane < planes; ++plane)
    {
      const double mean = cell.mean(plane);
      const double a = cell.light[plane][0] - mean, b = cell.light[plane][1] - mean;
      light.mean[plane] = mean + (a + b) / 3;
      light.perX[plane] = (a * by - b * ay) / (2 * area);
      light.perY[plane] = (b * ax - a * bx) / (2 * area);
    }
  }

  /// Spreads light evenly over a polygon.
  SCHLIEREN_HD void addPolygon(
    const Point (&at)[4], double area, double fraction, const Light& light, Rest& rest)
  {
    const Polygon polygon{ { at[0], at[1], at[2], at[3] }, area, fraction };
    const Box box = Box::around(polygon.at);
    if (!isInside(box))
    {
      const double low = maximum(box.low, 0.), high = minimum(box.high, rows_);
      addOutside(polygon, light, { box.left, box.right, box.low, minimum(box.high, 0.) }, rest);
      addOutside(polygon, light, { box.left, box.right, maximum(box.low, rows_), box.high }, rest);
      addOutside(polygon, light, { box.left, minimum(box.right, 0.), low, high }, rest);
      addOutside(polygon, light, { maximum(box.left, columns_), box.right, low, high }, rest);
    }
    if (!isNear(box))
    {
      return;
    }
    const auto firstColumn = static_cast<std::int64_t>(maximum(box.left, 0.));
    const auto firstRow = static_cast<std::int64_t>(maximum(box.low, 0.));
    const auto lastColumn = static_cast<std::int64_t>(minimum(box.right, columns_ - 1));
    const auto lastRow = static_cast<std::int64_t>(minimum(box.high, rows_ - 1));
    constexpr int size = coverageTileSize;
    for (std::int64_t row = firstRow; row <= lastRow; row += size)
    {
      for (std::int64_t column = firstColumn; column <= lastColumn; column += size)
      {
        const int columns =
          lastColumn - column < size ? static_cast<int>(lastColumn - column) + 1 : size;
        const int rows = lastRow - row < size ? static_cast<int>(lastRow - row) + 1 : size;
        for (int first = 0; first < rows; first += rowsAtOnce)
        {
          addRows(
            columns, first, minimum(first + rowsAtOnce, rows), column, row, polygon, light, rest);
        }
      }
    }
  }

  /// Some rows of the tile whose lower left pixel is (column, row).
  SCHLIEREN_HD void addRows(int columns, int firstRow, int endRow, std::int64_t column,
    std::int64_t row, const Polygon& polygon, const Light& light, Rest& rest)
  {
    const Point origin = { static_cast<double>(column), static_cast<double>(row) };
    CoverageRows<rowsAtOnce> tile(columns, firstRow, endRow);
    forEachCorner(polygon.at,
      [&](const Point& a, const Point& b, const Point&)
      { tile.addEdge(a.x - origin.x, a.y - origin.y, b.x - origin.x, b.y - origin.y); });
    for (int j = firstRow; j < endRow; ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        const Moments& covered = tile.pixels[j - firstRow][i];
        if (covered.area == 0)
        {
          continue;
        }
        rest.column = column + i;
        rest.row = row + j;
        for (int plane = 0; plane < planes; ++plane)
        {
          give(plane, lightOf(covered, origin, polygon, light, plane), true, rest);
        }
      }
    }
  }

  /// The light on a part of a polygon. Where its moments are taken from: `origin`.
  SCHLIEREN_HD std::int64_t lightOf(const Moments& covered, const Point& origin,
    const Polygon& polygon, const Light& light, int plane) const
  {
    const double sum = light.mean[plane] * covered.area +
      light.perX[plane] * (covered.x - covered.area * (light.centre.x - origin.x)) +
      light.perY[plane] * (covered.y - covered.area * (light.centre.y - origin.y));
    const double part = sum / polygon.area;
    return part > 0 ? film_.fixed(part * polygon.fraction) : 0;
  }

  /// What of a polygon's light falls into a box beside the film.
  SCHLIEREN_HD void addOutside(
    const Polygon& polygon, const Light& light, const Box& box, Rest& rest)
  {
    const double width = box.right - box.left, height = box.high - box.low;
    if (!(width > 0 && height > 0))
    {
      return;
    }
    // As if the box were a pixel.
    CoverageRows<1, 1> tile(1, 0, 1);
    forEachCorner(polygon.at,
      [&](const Point& a, const Point& b, const Point&)
      {
        tile.addEdge((a.x - box.left) / width, (a.y - box.low) / height, (b.x - box.left) / width,
          (b.y - box.low) / height);
      });
    const double size = width * height;
    const Moments& inBox = tile.pixels[0][0];
    const Moments covered = { inBox.area * size, inBox.x * size * width, inBox.y * size * height };
    for (int plane = 0; plane < planes; ++plane)
    {
      give(plane, lightOf(covered, { box.left, box.low }, polygon, light, plane), false, rest);
    }
  }

  /// Spreads a cell that has no area, or far too much of it, over points.
  SCHLIEREN_HD void addPoints(const Cell& cell, double fraction, Rest& rest)
  {
    constexpr int perSide = 16;
    constexpr double each = 1. / (perSide * perSide);
    for (int j = 0; j < perSide; ++j)
    {
      for (int i = 0; i < perSide; ++i)
      {
        const double s = (i + 0.5) / perSide, t = (j + 0.5) / perSide;
        const auto between = [s, t](double a, double b, double c, double d)
        { return (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * d + s * c); };
        const double x = between(cell.at[0].x, cell.at[1].x, cell.at[2].x, cell.at[3].x);
        const double y = between(cell.at[0].y, cell.at[1].y, cell.at[2].y, cell.at[3].y);
        const bool isOnIt = x >= 0 && x < columns_ && y >= 0 && y < rows_;
        if (isOnIt)
        {
          rest.column = static_cast<std::int64_t>(x);
          rest.row = static_cast<std::int64_t>(y);
        }
        for (int plane = 0; plane < planes; ++plane)
        {
          const double(&light)[4] = cell.light[plane];
          const std::int64_t here =
            film_.fixed(between(light[0], light[1], light[2], light[3]) * each * fraction);
          give(plane, here, isOnIt, rest);
        }
      }
    }
  }

  const FilmSize film_;
  const double columns_, rows_;
  Deposit& deposit_;
};

} // namespace schlieren
