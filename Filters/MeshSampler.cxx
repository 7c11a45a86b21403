// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshSampler.h"

#include "CellTypes.h"
#include "FlatData.h"
#include "MeshCell.h"
#include "RefractivityValues.h"

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace filters
{

namespace
{

/// Planes of points: few, so that all threads have work; more than one, since cells that meet several
/// pieces are looked at several times.
constexpr int thickness = 4;

/// How far curved cells may reach out of the box of their points, in parts of its lengths.
constexpr double bulge = 0.05;

/// Rounding can put the last points of a grid out of the box that it spans, where no cell is.
constexpr double snap = 1e-3; // spacings

} // namespace

MeshSampler::MeshSampler(std::vector<vtkDataSet*> leaves, vtkImageData* grid, int flatAxis)
  : Leaves(std::move(leaves))
  , FlatAxis(flatAxis)
{
  double box[6] = { HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL };
  vtkIdType cells = 0;
  MeshCell cell(flatAxis);
  for (vtkDataSet* leaf : this->Leaves)
  {
    this->FirstCells.push_back(static_cast<std::uint32_t>(cells));
    cells += leaf->GetNumberOfCells();
    if (cells >= static_cast<vtkIdType>(Places::noCell))
    {
      throw std::runtime_error(
        "The input has more than 4294967294 cells, which cannot be resampled "
        "in one piece. Extract the part that is to be seen.");
    }
    const double* bounds = leaf->GetBounds();
    for (int axis = 0; axis < 3; ++axis)
    {
      box[2 * axis] = std::min(box[2 * axis], bounds[2 * axis]);
      box[2 * axis + 1] = std::max(box[2 * axis + 1], bounds[2 * axis + 1]);
    }
    if (leaf->GetNumberOfCells() > 0)
    {
      // VTK builds what it needs on the first call, which one thread has to make.
      double ofCell[6];
      leaf->GetCellBounds(0, ofCell);
      cell.set(leaf, 0);
      vtkNew<vtkGenericCell> first;
      leaf->GetCell(0, first);
    }
  }
  this->FirstCells.push_back(static_cast<std::uint32_t>(cells));

  const int* dimensions = grid->GetDimensions();
  this->Axis = 2;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->Spacing[axis] = grid->GetSpacing()[axis];
    const double reach = snap * this->Spacing[axis];
    for (int i = 0; i < dimensions[axis]; ++i)
    {
      double x = grid->GetOrigin()[axis] + i * this->Spacing[axis];
      for (const double end : { box[2 * axis], box[2 * axis + 1] })
      {
        x = std::abs(x - end) < reach ? end : x;
      }
      this->Coordinates[axis].push_back(x);
    }
    this->Axis = dimensions[axis] > dimensions[this->Axis] ? axis : this->Axis;
  }
  this->Pieces = (dimensions[this->Axis] + thickness - 1) / thickness;
}

std::array<MeshSampler::Range, 3> MeshSampler::pointsOf(int piece) const
{
  std::array<Range, 3> ranges;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ranges[axis] = { 0, static_cast<int>(this->Coordinates[axis].size()) - 1 };
  }
  ranges[this->Axis][0] = thickness * piece;
  ranges[this->Axis][1] = std::min(ranges[this->Axis][1], thickness * (piece + 1) - 1);
  return ranges;
}

/// Points in the cell's box; where there are none, or NaN, some first is greater than the last.
std::array<MeshSampler::Range, 3> MeshSampler::pointsWithin(vtkDataSet* data, vtkIdType cell) const
{
  double bounds[6];
  data->GetCellBounds(cell, bounds);
  const bool isCurved =
    !vtkCellTypeUtilities::IsLinear(static_cast<unsigned char>(data->GetCellType(cell)));
  std::array<Range, 3> ranges;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::vector<double>& x = this->Coordinates[axis];
    const int count = static_cast<int>(x.size());
    if (static_cast<int>(axis) == this->FlatAxis)
    {
      ranges[axis] = { 0, count - 1 };
      continue;
    }
    const double more = isCurved ? bulge * (bounds[2 * axis + 1] - bounds[2 * axis]) : 0;
    const double low = bounds[2 * axis] - more, high = bounds[2 * axis + 1] + more;
    if (!(low <= high))
    {
      ranges[axis] = { 0, -1 };
      continue;
    }
    const auto guess = [&](double at)
    {
      const double place = (at - x[0]) / this->Spacing[axis];
      return place > 0 ? static_cast<int>(std::min(place, count - 1.)) : 0; // 0 of NaN, too
    };
    int first = guess(low), last = guess(high);
    while (first > 0 && x[static_cast<std::size_t>(first - 1)] >= low)
    {
      --first;
    }
    while (first < count && x[static_cast<std::size_t>(first)] < low)
    {
      ++first;
    }
    while (last + 1 < count && x[static_cast<std::size_t>(last + 1)] <= high)
    {
      ++last;
    }
    while (last >= 0 && x[static_cast<std::size_t>(last)] > high)
    {
      --last;
    }
    ranges[axis] = { first, last };
  }
  return ranges;
}

std::size_t MeshSampler::leafOf(std::uint32_t cell) const
{
  return static_cast<std::size_t>(
    std::upper_bound(this->FirstCells.begin(), this->FirstCells.end(), cell) -
    this->FirstCells.begin() - 1);
}

void MeshSampler::sort(Cells cells)
{
  // The pieces that a cell meets.
  std::vector<Range> met(this->FirstCells.back(), Range{ 0, -1 });
  for (std::size_t leaf = 0; leaf < this->Leaves.size(); ++leaf)
  {
    vtkDataSet* data = this->Leaves[leaf];
    vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
    const int dimension = this->FlatAxis < 0 ? 3 : 2;
    vtkSMPTools::For(0, data->GetNumberOfCells(),
      [&, leaf](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const bool isHidden = (ghosts->GetValue(i) & hiddenCellBits) != 0;
          if (isHidden != (cells == Cells::Hidden) || dimensionOfCell(data, i) != dimension)
          {
            continue;
          }
          const std::array<Range, 3> points = this->pointsWithin(data, i);
          if (std::all_of(
                points.begin(), points.end(), [](const Range& r) { return r[0] <= r[1]; }))
          {
            met[this->FirstCells[leaf] + static_cast<std::size_t>(i)] = {
              points[this->Axis][0] / thickness, points[this->Axis][1] / thickness
            };
          }
        }
      });
  }
  this->Starts.assign(static_cast<std::size_t>(this->Pieces) + 1, 0);
  for (const Range& pieces : met)
  {
    for (int piece = pieces[0]; piece <= pieces[1]; ++piece)
    {
      ++this->Starts[static_cast<std::size_t>(piece) + 1];
    }
  }
  for (std::size_t piece = 1; piece < this->Starts.size(); ++piece)
  {
    this->Starts[piece] += this->Starts[piece - 1];
  }
  this->Sorted.resize(this->Starts.back());
  std::vector<std::size_t> next(this->Starts.begin(), this->Starts.end() - 1);
  for (std::size_t cell = 0; cell < met.size(); ++cell)
  {
    for (int piece = met[cell][0]; piece <= met[cell][1]; ++piece)
    {
      this->Sorted[next[static_cast<std::size_t>(piece)]++] = static_cast<std::uint32_t>(cell);
    }
  }
}

Places MeshSampler::find(int piece) const
{
  const std::array<Range, 3> box = this->pointsOf(piece);
  std::array<std::size_t, 3> lengths;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lengths[axis] = static_cast<std::size_t>(box[axis][1] - box[axis][0] + 1);
  }
  Places places;
  const std::size_t count = lengths[0] * lengths[1] * lengths[2];
  places.cells.assign(count, Places::noCell);
  places.coordinates.resize(count);
  std::vector<float> misses(count, std::numeric_limits<float>::infinity());
  MeshCell cell(this->FlatAxis);
  const auto here = static_cast<std::size_t>(piece);
  for (std::size_t at = this->Starts[here]; at < this->Starts[here + 1]; ++at)
  {
    const std::uint32_t number = this->Sorted[at];
    const std::size_t leaf = this->leafOf(number);
    const auto ofLeaf = static_cast<vtkIdType>(number - this->FirstCells[leaf]);
    std::array<Range, 3> points = this->pointsWithin(this->Leaves[leaf], ofLeaf);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      points[axis][0] = std::max(points[axis][0], box[axis][0]);
      points[axis][1] = std::min(points[axis][1], box[axis][1]);
    }
    for (int k = points[2][0]; k <= points[2][1]; ++k)
    {
      for (int j = points[1][0]; j <= points[1][1]; ++j)
      {
        const std::size_t row = (static_cast<std::size_t>(k - box[2][0]) * lengths[1] +
                                  static_cast<std::size_t>(j - box[1][0])) *
          lengths[0];
        for (int i = points[0][0]; i <= points[0][1]; ++i)
        {
          const std::size_t point = row + static_cast<std::size_t>(i - box[0][0]);
          if (misses[point] == 0)
          {
            continue;
          }
          cell.set(this->Leaves[leaf], ofLeaf);
          const double x[3] = { this->Coordinates[0][static_cast<std::size_t>(i)],
            this->Coordinates[1][static_cast<std::size_t>(j)],
            this->Coordinates[2][static_cast<std::size_t>(k)] };
          double coordinates[3], outside;
          if (cell.find(x, coordinates, outside) && static_cast<float>(outside) < misses[point])
          {
            misses[point] = static_cast<float>(outside);
            places.cells[point] = number;
            std::transform(coordinates, coordinates + 3, places.coordinates[point].begin(),
              [](double value) { return static_cast<float>(value); });
          }
        }
      }
    }
  }
  return places;
}

/// Calls visit(point of the piece, point of the grid, its coordinates).
template <class Visit>
void MeshSampler::forPoints(int piece, const Visit& visit) const
{
  const std::array<Range, 3> box = this->pointsOf(piece);
  const std::size_t along = this->Coordinates[0].size(), across = this->Coordinates[1].size();
  std::size_t point = 0;
  for (auto k = static_cast<std::size_t>(box[2][0]); k <= static_cast<std::size_t>(box[2][1]); ++k)
  {
    for (auto j = static_cast<std::size_t>(box[1][0]); j <= static_cast<std::size_t>(box[1][1]);
         ++j)
    {
      for (auto i = static_cast<std::size_t>(box[0][0]); i <= static_cast<std::size_t>(box[0][1]);
           ++i)
      {
        const double x[3] = { this->Coordinates[0][i], this->Coordinates[1][j],
          this->Coordinates[2][k] };
        visit(point++, (k * across + j) * along + i, x);
      }
    }
  }
}

void MeshSampler::interpolate(
  int piece, const Places& places, double* values, unsigned char* valid) const
{
  MeshCell cell(this->FlatAxis);
  std::size_t leaf = 0;
  const double* ofPoints = nullptr;
  this->forPoints(piece,
    [&](std::size_t from, std::size_t to, const double x[3])
    {
      const std::uint32_t number = places.cells[from];
      if (number == Places::noCell)
      {
        values[to] = 0;
        valid[to] = 0;
        return;
      }
      if (!ofPoints || number < this->FirstCells[leaf] || number >= this->FirstCells[leaf + 1])
      {
        leaf = this->leafOf(number);
        ofPoints = vtkDoubleArray::SafeDownCast(this->Leaves[leaf]->GetPointData()->GetScalars())
                     ->GetPointer(0);
      }
      cell.set(this->Leaves[leaf], static_cast<vtkIdType>(number - this->FirstCells[leaf]));
      const double coordinates[3] = { places.coordinates[from][0], places.coordinates[from][1],
        places.coordinates[from][2] };
      values[to] = cell.valueAt(x, coordinates, ofPoints);
    });
}

void MeshSampler::cover(int piece, const Places& places, unsigned char* outside) const
{
  this->forPoints(piece,
    [&](std::size_t from, std::size_t to, const double* /*x*/)
    { outside[to] = places.cells[from] == Places::noCell ? outside[to] : 0; });
}

} // namespace filters
