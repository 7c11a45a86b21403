// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which points of a lattice may be in a cell.
#include "Cells/LatticeInCells.h"

#include <algorithm>
#include <cmath>

namespace filters
{

struct LatticeInCells::Rows
{
  const Vector* inverse; // of the cell's columns
  const schlieren::Lattice& lattice;
  double start[3];        // of the lattice, from the cell's middle
  double along[4];        // changes from one point to the next, of the coordinates and their sum
  std::size_t length = 0; // of a row, in points
  std::size_t count = 0;  // of rows in a layer

  Rows(const schlieren::Lattice& of, bool isTetrahedron, const Vector& middle, const Vector rows[3])
    : inverse{ rows }
    , lattice{ of }
    , length(static_cast<std::size_t>(of.points[0]))
    , count(static_cast<std::size_t>(of.points[1]))
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->start[axis] = of.first[axis] - middle[axis];
      this->along[axis] = rows[axis][0] * of.spacing[0];
    }
    this->along[3] = this->along[0] + this->along[1] + (isTetrahedron ? this->along[2] : 0);
  }

  /// Computes the coordinates of row j, k where it begins.
  void begin(int j, int k, double at[3]) const
  {
    const double y = this->start[1] + j * this->lattice.spacing[1];
    const double z = this->start[2] + k * this->lattice.spacing[2];
    for (int i = 0; i < 3; ++i)
    {
      at[i] =
        this->inverse[i][0] * this->start[0] + this->inverse[i][1] * y + this->inverse[i][2] * z;
    }
  }
};

/// Collects the points that may be in the cell, row by row.
void LatticeInCells::scan(const NormalCell& cell, const Vector& middle, const Vector rows[3])
{
  const Rows of(this->Lattice, cell.shape == CellShape::Tetrahedron, middle, rows);
  if (this->GivenBegin)
  {
    this->scanGiven(cell, of);
  }
  else
  {
    this->scanBox(cell, of);
  }
  this->flush(cell);
}

void LatticeInCells::collect(
  const NormalCell& cell, const Rows& rows, const double at[3], int i, std::size_t point)
{
  if (this->Count == CellPoints::most)
  {
    this->flush(cell);
  }
  for (int n = 0; n < 3; ++n)
  {
    this->Points.normal[n][this->Count] = at[n] + i * rows.along[n];
  }
  this->Places[this->Count++] = point;
}

void LatticeInCells::scanGiven(const NormalCell& cell, const Rows& rows)
{
  for (const std::uint16_t* given = this->GivenBegin; given != this->GivenEnd; ++given)
  {
    const std::size_t row = *given / rows.length;
    double at[3];
    rows.begin(static_cast<int>(row % rows.count), static_cast<int>(row / rows.count), at);
    const auto i = static_cast<int>(*given % rows.length);
    this->collect(cell, rows, at, i, *given);
  }
}

/// Cuts each row of the box by the cell's slabs.
void LatticeInCells::scanBox(const NormalCell& cell, const Rows& rows)
{
  constexpr double parallel = 1e300; // 1 / 0, but without NaN
  const bool isTetrahedron = cell.shape == CellShape::Tetrahedron;
  const int slabs = isTetrahedron || cell.shape == CellShape::Wedge ? 4 : 3;
  double perAlong[4];
  for (int i = 0; i < slabs; ++i)
  {
    perAlong[i] = std::abs(rows.along[i]) > 1 / parallel ? 1 / rows.along[i] : parallel;
  }
  for (int k = this->First[2]; k <= this->Last[2]; ++k)
  {
    for (int j = this->First[1]; j <= this->Last[1]; ++j)
    {
      double at[4];
      rows.begin(j, k, at);
      at[3] = at[0] + at[1] + (isTetrahedron ? at[2] : 0);
      double low = this->First[0], high = this->Last[0];
      for (int i = 0; i < slabs; ++i)
      {
        const double a = (this->Low[i] - at[i]) * perAlong[i];
        const double b = (this->High[i] - at[i]) * perAlong[i];
        low = std::max(low, std::min(a, b));
        high = std::min(high, std::max(a, b));
      }
      if (!(low <= high))
      {
        continue;
      }
      int i = static_cast<int>(low);
      i += i < low ? 1 : 0;
      const std::size_t row =
        (static_cast<std::size_t>(k) * rows.count + static_cast<std::size_t>(j)) * rows.length;
      for (const int last = static_cast<int>(high); i <= last; ++i)
      {
        const std::size_t point = row + static_cast<std::size_t>(i);
        if (!this->isSettled(point))
        {
          this->collect(cell, rows, at, i, point);
        }
      }
    }
  }
}

} // namespace filters
