// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Locates points of a lattice in curved cells and in those that are neither linear nor curved.
#include "Cells/LatticeInCells.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace filters
{

/// Returns whether the best cell is not yet known of one of the points between First and Last.
bool LatticeInCells::hasUnsettled() const
{
  const auto row = static_cast<std::size_t>(this->Lattice.points[0]);
  const auto rows = static_cast<std::size_t>(this->Lattice.points[1]);
  if (this->GivenBegin)
  {
    return std::any_of(this->GivenBegin, this->GivenEnd,
      [&](std::size_t point)
      {
        const std::size_t index[3] = { point % row, point / row % rows, point / row / rows };
        bool isWithin = !this->isSettled(point);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const auto at = static_cast<int>(index[axis]);
          isWithin = isWithin && at >= this->First[axis] && at <= this->Last[axis];
        }
        return isWithin;
      });
  }
  for (int k = this->First[2]; k <= this->Last[2]; ++k)
  {
    for (int j = this->First[1]; j <= this->Last[1]; ++j)
    {
      const std::size_t first =
        (static_cast<std::size_t>(k) * rows + static_cast<std::size_t>(j)) * row;
      for (int i = this->First[0]; i <= this->Last[0]; ++i)
      {
        if (!this->isSettled(first + static_cast<std::size_t>(i)))
        {
          return true;
        }
      }
    }
  }
  return false;
}

/// Locates points in the parts of a curved cell, within the cell's box.
void LatticeInCells::addCurved()
{
  int first[3] = { 0, 0, 0 }, last[3];
  std::copy_n(this->Lattice.points.begin(), 3, last);
  if (!this->GivenBegin)
  {
    std::copy_n(this->First, 3, first);
    std::copy_n(this->Last, 3, last);
  }
  const auto enter = [&](const Vector& low, const Vector& high)
  {
    bool hasPoints = this->enter(low, high);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->First[axis] = std::max(this->First[axis], first[axis]);
      this->Last[axis] = std::min(this->Last[axis], last[axis]);
      hasPoints = hasPoints && this->First[axis] <= this->Last[axis];
    }
    return hasPoints && this->hasUnsettled();
  };
  NormalCell other{};
  other.shape = CellShape::Other;
  this->Curved->forParts(enter,
    [&](const CurvedPart& part, const Vector& middle, const Vector rows[3], const Vector& low,
      const Vector& high)
    {
      this->Part = &part;
      this->Tolerance = part.tolerance;
      std::copy_n(low.begin(), 3, this->Low);
      std::copy_n(high.begin(), 3, this->High);
      this->scan(other, middle, rows);
    });
  this->Part = nullptr;
}

/// Locates points by MeshCell. Skips most points outside by a linear cell with the same corners,
/// out of which curved ones do not reach far.
void LatticeInCells::addOther(const CellTree::Cell& cell)
{
  const double infinity = std::numeric_limits<double>::infinity();
  Vector rows[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  Vector origin = {};
  std::fill_n(this->Low, 4, -infinity);
  std::fill_n(this->High, 4, infinity);
  const CellShape skeleton = skeletonOf(cell.block->type(cell.id));
  if (skeleton != CellShape::Other)
  {
    const int count = cornersOf(skeleton);
    vtkIdType points[8];
    cell.block->points(cell.id, count, points);
    double corners[3][8];
    cell.block->coordinates(points[0], origin.data());
    for (int i = 0; i < count; ++i)
    {
      double x[3];
      cell.block->coordinates(points[i], x);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        corners[axis][i] = x[axis] - origin[axis];
      }
    }
    Vector columns[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const Polynomial place = polynomialOf(skeleton, corners[axis]);
      for (std::size_t along = 0; along < 3; ++along)
      {
        columns[along][axis] = place[along + 1];
      }
    }
    if (invert(columns, rows))
    {
      this->setLimits(cell, origin, rows);
    }
    else
    {
      rows[0] = { 1, 0, 0 };
      rows[1] = { 0, 1, 0 };
      rows[2] = { 0, 0, 1 };
    }
  }
  if (!this->Other)
  {
    this->Other = std::make_unique<MeshCell>();
  }
  this->Other->set(cell.block->data(), cell.id);
  this->OtherValues = cell.block->values();
  this->Tolerance = infinity; // MeshCell has its own tolerance
  NormalCell other{};
  other.shape = CellShape::Other;
  this->scan(other, origin, rows);
}

/// Bounds the normal coordinates by all points of a cell.
void LatticeInCells::setLimits(
  const CellTree::Cell& cell, const Vector& origin, const Vector rows[3])
{
  std::fill_n(this->Low, 3, std::numeric_limits<double>::infinity());
  std::fill_n(this->High, 3, -std::numeric_limits<double>::infinity());
  cell.block->forPoints(cell.id,
    [&](vtkIdType point)
    {
      Vector x;
      cell.block->coordinates(point, x.data());
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        x[axis] -= origin[axis];
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        const double at = dot(rows[axis], x);
        this->Low[axis] = std::min(this->Low[axis], at);
        this->High[axis] = std::max(this->High[axis], at);
      }
    });
  for (int axis = 0; axis < 3; ++axis)
  {
    const double more = bulge * (this->High[axis] - this->Low[axis]);
    this->Low[axis] -= more;
    this->High[axis] += more;
  }
}

void LatticeInCells::locateInOther()
{
  const auto row = static_cast<std::size_t>(this->Lattice.points[0]);
  const std::size_t layer = row * static_cast<std::size_t>(this->Lattice.points[1]);
  for (int i = 0; i < this->Count; ++i)
  {
    const std::size_t point = this->Places[i];
    const std::size_t index[3] = { point % row, point % layer / row, point / layer };
    double x[3], coordinates[3], miss;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      x[axis] =
        this->Lattice.first[axis] + static_cast<double>(index[axis]) * this->Lattice.spacing[axis];
    }
    const bool isFound = this->Other->find(x, coordinates, miss);
    this->Points.miss[i] = isFound ? miss : std::numeric_limits<double>::infinity();
    this->Points.value[i] = isFound ? this->Other->valueAt(x, coordinates, this->OtherValues) : 0;
  }
}

} // namespace filters
