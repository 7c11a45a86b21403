// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// How much of each pixel a polygon covers, exactly: by Green's theorem a sum over its edges, each cut where
// it meets the pixels' borders.
#pragma once

#include "Math/HostDevice.h"

namespace schlieren
{

/// Integrals of 1, x and y over an area.
struct Moments
{
  double area, x, y;
};

/// Pixels of a tile along each axis, at most. Pixel (i, j) is [i, i + 1] x [j, j + 1].
constexpr int coverageTileSize = 8;

/// Some rows of a tile, `rowsAtOnce` at most, of `size` pixels at most, and what a polygon covers of their pixels. How many rows there are at
/// once changes no bit of it.
template <int rowsAtOnce, int size = coverageTileSize>
struct CoverageRows
{
  int columns;
  int firstRow, endRow;             ///< of the tile
  Moments pixels[rowsAtOnce][size]; ///< from firstRow on

  SCHLIEREN_HD CoverageRows(int columnCount, int first, int end)
    : columns(columnCount)
    , firstRow(first)
    , endRow(end)
  {
    for (int j = 0; j < endRow - firstRow; ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        pixels[j][i] = { 0, 0, 0 };
      }
    }
  }

  /// Adds the edge of a polygon from a to b. All edges together give what is on their left, negative where
  /// they go round it clockwise.
  SCHLIEREN_HD void addEdge(double xa, double ya, double xb, double yb)
  {
    const bool rises = yb > ya;
    const double x0 = rises ? xa : xb, y0 = rises ? ya : yb;
    const double x1 = rises ? xb : xa, y1 = rises ? yb : ya;
    if (!(y1 > y0) || y1 <= firstRow || y0 >= endRow)
    {
      return;
    }
    const double perRow = (x1 - x0) / (y1 - y0);
    // What is to the right of a rising edge is outside.
    const double sign = rises ? -1 : 1;
    const bool startsHere = y0 > firstRow;
    double x = startsHere ? x0 : x0 + (firstRow - y0) * perRow;
    double y = startsHere ? y0 : firstRow;
    for (int row = static_cast<int>(y); row < endRow && y < y1; ++row)
    {
      const bool isLast = y1 <= row + 1;
      const double nextX = isLast ? x1 : x0 + (row + 1 - y0) * perRow;
      const double nextY = isLast ? y1 : row + 1;
      Moments* const here = pixels[row - firstRow];
      if (nextX >= x)
      {
        addWithinRow(here, sign, x, y, nextX, nextY);
      }
      else
      {
        addWithinRow(here, -sign, nextX, nextY, x, y);
      }
      x = nextX;
      y = nextY;
    }
  }

private:
  /// Adds `sign` times what is to the right of a piece of an edge, from left to right.
  SCHLIEREN_NOINLINE void addWithinRow(
    Moments* row, double sign, double x0, double y0, double x1, double y1) const
  {
    if (x0 < 0)
    {
      const double y = x1 > 0 ? y0 + (y1 - y0) * (-x0 / (x1 - x0)) : y1;
      addRightOf(row, 0, sign, y0, y);
      if (x1 <= 0)
      {
        return;
      }
      x0 = 0;
      y0 = y;
    }
    for (int column = x0 < columns ? static_cast<int>(x0) : columns; column < columns; ++column)
    {
      const double right = column + 1;
      const bool isLast = x1 <= right;
      const double y = isLast ? y1 : y0 + (y1 - y0) * ((right - x0) / (x1 - x0));
      const double x = isLast ? x1 : right;
      const double u0 = right - x0, u1 = right - x;
      const double height = sign * (y - y0);
      const double area = 0.5 * height * (u0 + u1);
      row[column].area += area;
      row[column].x += right * area - height * (u0 * u0 + u0 * u1 + u1 * u1) / 6;
      row[column].y += height * (u0 * (2 * y0 + y) + u1 * (y0 + 2 * y)) / 6;
      addRightOf(row, column + 1, sign, y0, y);
      if (isLast)
      {
        return;
      }
      x0 = x;
      y0 = y;
    }
  }

  SCHLIEREN_HD void addRightOf(Moments* row, int first, double sign, double y0, double y1) const
  {
    const double area = sign * (y1 - y0);
    const double middle = 0.5 * (y0 + y1);
    for (int column = first; column < columns; ++column)
    {
      row[column].area += area;
      row[column].x += area * (column + 0.5);
      row[column].y += area * middle;
    }
  }
};

} // namespace schlieren
