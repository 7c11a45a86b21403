// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

class vtkDataSet;
class vtkUnsignedCharArray;

namespace filters
{

/// Treatment of copies of another rank's cells (DUPLICATECELL).
enum class Copies
{
  Used,      ///< like all others
  Neighbours ///< only for results at points
};

/// The change of values around a point, relative to its value, and its limits.
struct PointTrend
{
  float gradient[3] = {};
  float lowest = 0, highest = 0;
};

/// Range and moments of the cells around a point, over which its value is a mean if values belong
/// to cells; in the middle of a polyhedron those of its corners, if values belong to points. Moments are relative to
/// the point, values to the mean. All are 0 where a value is that at the point.
struct CellsAround
{
  float first[3] = {};
  float second[6] = {}; // xx, yy, zz, xy, yz, zx
  float lowest = 0, highest = 0;
};

/**
 * The points and cells of a dataset as plain arrays, for several threads.
 *
 * VTK's virtual functions for a cell or point take longer than the work on their results. Uses the
 * dataset's own arrays (structured and unstructured grids) or copies. The dataset has one double
 * scalar at each point, and must outlive this.
 */
class MeshArrays
{
public:
  explicit MeshArrays(vtkDataSet* data);

  vtkDataSet* data() const { return this->Data; }
  vtkIdType cells() const { return this->CellCount; }
  vtkIdType points() const { return this->PointCount; }
  const double* values() const { return this->Values; }

  /// Returns an entry for each point if some values are means; else null.
  const CellsAround* cellsAround() const { return this->Around; }
  /// Sets values at the points that replace the dataset's.
  void setValues(std::vector<double> values);

  /// Returns the memory beyond the dataset's.
  std::size_t bytes() const;

  /// Returns an entry for each point; null if none were set.
  const PointTrend* trends() const { return this->Trends.empty() ? nullptr : this->Trends.data(); }
  void setTrends(std::vector<PointTrend> trends) { this->Trends = std::move(trends); }

  /// Returns the VTK cell type, also of hidden cells.
  int type(vtkIdType cell) const { return this->Types ? this->Types[cell] : this->Type; }

  /// Lists all types of cells.
  std::vector<int> types() const;

  /// Returns whether no bit of hiddenCellBits hides the cell.
  bool isVisible(vtkIdType cell) const;
  bool isCopy(vtkIdType cell) const;

  /// Returns whether cells have three indices, by which those around a point are known.
  bool isStructured() const { return this->Layer > 0; }

  /// Calls visit(cell) for all cells around a point of a structured mesh.
  template <class Visit>
  void forCellsAround(vtkIdType point, const Visit& visit) const
  {
    const vtkIdType cells[3] = { this->CellsAlong, this->CellsAcross,
      this->CellCount / (this->CellsAlong * this->CellsAcross) };
    const vtkIdType at[3] = { point % this->Row, point % this->Layer / this->Row,
      point / this->Layer };
    for (vtkIdType k = at[2] > 0 ? at[2] - 1 : 0; k <= at[2] && k < cells[2]; ++k)
    {
      for (vtkIdType j = at[1] > 0 ? at[1] - 1 : 0; j <= at[1] && j < cells[1]; ++j)
      {
        for (vtkIdType i = at[0] > 0 ? at[0] - 1 : 0; i <= at[0] && i < cells[0]; ++i)
        {
          visit((k * cells[1] + j) * cells[0] + i);
        }
      }
    }
  }

  /// Calls visit(point) for all points of a cell, in VTK's order.
  template <class Visit>
  void forPoints(vtkIdType cell, const Visit& visit) const
  {
    if (this->Layer > 0)
    {
      vtkIdType points[8];
      this->boxPoints(cell, points);
      for (const vtkIdType point : points)
      {
        visit(point);
      }
    }
    else if (this->Points64)
    {
      for (vtkTypeInt64 i = this->Offsets64[cell]; i < this->Offsets64[cell + 1]; ++i)
      {
        visit(static_cast<vtkIdType>(this->Points64[i]));
      }
    }
    else
    {
      for (vtkTypeInt32 i = this->Offsets32[cell]; i < this->Offsets32[cell + 1]; ++i)
      {
        visit(static_cast<vtkIdType>(this->Points32[i]));
      }
    }
  }

  /// Copies the first `count` points of a cell with at least as many.
  void points(vtkIdType cell, int count, vtkIdType* points) const
  {
    if (this->Layer > 0)
    {
      this->boxPoints(cell, points);
    }
    else if (this->Points64)
    {
      const vtkTypeInt64* from = this->Points64 + this->Offsets64[cell];
      for (int i = 0; i < count; ++i)
      {
        points[i] = static_cast<vtkIdType>(from[i]);
      }
    }
    else
    {
      const vtkTypeInt32* from = this->Points32 + this->Offsets32[cell];
      for (int i = 0; i < count; ++i)
      {
        points[i] = from[i];
      }
    }
  }

  /// Prefetch a cell that will be read soon: first its type and the position of its points, then,
  /// when these have arrived, the points.
  void fetchCell(vtkIdType cell) const
  {
    fetch(this->Types, cell);
    fetch(this->Offsets64, cell);
    fetch(this->Offsets32, cell);
  }
  void fetchPoints(vtkIdType cell) const
  {
    if (this->Points64)
    {
      fetch(this->Points64, this->Offsets64[cell]);
    }
    else if (this->Points32)
    {
      fetch(this->Points32, this->Offsets32[cell]);
    }
  }

  void coordinates(vtkIdType point, double x[3]) const
  {
    if (this->Doubles)
    {
      const double* from = this->Doubles + 3 * point;
      x[0] = from[0];
      x[1] = from[1];
      x[2] = from[2];
    }
    else
    {
      const float* from = this->Floats + 3 * point;
      x[0] = from[0];
      x[1] = from[1];
      x[2] = from[2];
    }
  }

private:
  template <class Number>
  static void fetch(const Number* numbers, vtkIdType at)
  {
#if defined(__GNUC__)
    if (numbers)
    {
      __builtin_prefetch(numbers + at);
    }
#else
    (void)numbers;
    (void)at;
#endif
  }

  void setPoints();
  void setCells();
  void copyCells();

  /// Finds the points of a structured cell. The order of voxels differs from that of hexahedra.
  void boxPoints(vtkIdType cell, vtkIdType points[8]) const
  {
    const vtkIdType row = cell / this->CellsAlong, layer = row / this->CellsAcross;
    const vtkIdType first = cell + row + layer * this->Row;
    const vtkIdType second = first + this->Row;
    points[0] = first;
    points[1] = first + 1;
    points[2] = this->IsVoxel ? second : second + 1;
    points[3] = this->IsVoxel ? second + 1 : second;
    for (int i = 0; i < 4; ++i)
    {
      points[i + 4] = points[i] + this->Layer;
    }
  }

  vtkDataSet* Data;
  vtkIdType CellCount, PointCount;
  const double* Values = nullptr;
  const CellsAround* Around = nullptr;
  std::vector<double> OwnValues;
  const unsigned char* Ghosts = nullptr;
  std::vector<PointTrend> Trends;

  const float* Floats = nullptr;
  const double* Doubles = nullptr;
  std::vector<double> OwnPoints;

  int Type = 0; // of all cells, if Types is null
  const unsigned char* Types = nullptr;
  std::vector<unsigned char> OwnTypes;
  // Strides of structured grids: cells in a row and in a layer; points in a row and in a layer.
  vtkIdType CellsAlong = 0, CellsAcross = 0, Row = 0, Layer = 0;
  bool IsVoxel = false;
  const vtkTypeInt64 *Offsets64 = nullptr, *Points64 = nullptr;
  const vtkTypeInt32 *Offsets32 = nullptr, *Points32 = nullptr;
  std::vector<vtkTypeInt64> OwnOffsets, OwnCells;
};

} // namespace filters
