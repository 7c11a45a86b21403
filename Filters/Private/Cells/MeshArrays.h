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

/// What is done with cells that are copies of another rank's (DUPLICATECELL).
enum class Copies
{
  Used,      ///< the same as with all others
  Neighbours ///< only what is known of points depends on them
};

/// How values continue around a point, and between which limits, counted from its own value.
struct PointTrend
{
  float gradient[3] = {};
  float lowest = 0, highest = 0;
};

/// What the value at a point is a mean of, where values belong to cells: of those around it, each by itself. Moments are
/// counted from the point, values from the mean.
struct CellsAround
{
  float first[3] = {};
  float second[6] = {}; // xx, yy, zz, xy, yz, zx
  float lowest = 0, highest = 0;
};

/**
 * The points and cells of a dataset as plain arrays, for many threads at once.
 *
 * VTK's virtual functions for one cell or point take longer than what is done with their results. Arrays are
 * the dataset's own where it has them (structured and unstructured grids), else copies. The dataset has one
 * double scalar at each point, and must outlive this.
 */
class MeshArrays
{
public:
  explicit MeshArrays(vtkDataSet* data);

  vtkDataSet* data() const { return this->Data; }
  vtkIdType cells() const { return this->CellCount; }
  vtkIdType points() const { return this->PointCount; }
  const double* values() const { return this->Values; }

  /// Of each point, where its value is a mean over cells; else null.
  const CellsAround* cellsAround() const { return this->Around; }
  /// Others than the dataset's, at the points themselves.
  void setValues(std::vector<double> values);

  /// Memory of what is not the dataset's own.
  std::size_t bytes() const;

  /// Of each point; null where nobody has set them.
  const PointTrend* trends() const { return this->Trends.empty() ? nullptr : this->Trends.data(); }
  void setTrends(std::vector<PointTrend> trends) { this->Trends = std::move(trends); }

  /// The VTK cell type, whether or not the cell is hidden.
  int type(vtkIdType cell) const { return this->Types ? this->Types[cell] : this->Type; }

  /// All types that there are.
  std::vector<int> types() const;

  /// Whether no bit of hiddenCellBits hides it.
  bool isVisible(vtkIdType cell) const;
  bool isCopy(vtkIdType cell) const;

  /// Whether cells are numbered by three indices, so that those around a point are known.
  bool isStructured() const { return this->Layer > 0; }

  /// Calls visit(number of the cell) for all cells around a point of a structured mesh.
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

  /// Calls visit(number of the point) for all points of a cell, in VTK's order.
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

  /// The first `count` points of a cell, which has as many.
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

  /// Fetch what is read of a cell that comes soon into the cache: first the cell's type and where its points stand; then,
  /// when that is there, the points. Nothing else changes.
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
  bool setStructure(const int dimensions[3]);
  void copyCells();

  /// A cell of a structured grid. The order of voxels differs from that of hexahedra.
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

  int Type = 0; // of all cells where Types is null
  const unsigned char* Types = nullptr;
  std::vector<unsigned char> OwnTypes;
  // Of structured grids: cells in a row, rows of cells in a layer; points in a row and in a layer.
  vtkIdType CellsAlong = 0, CellsAcross = 0, Row = 0, Layer = 0;
  bool IsVoxel = false;
  const vtkTypeInt64 *Offsets64 = nullptr, *Points64 = nullptr;
  const vtkTypeInt32 *Offsets32 = nullptr, *Points32 = nullptr;
  std::vector<vtkTypeInt64> OwnOffsets, OwnCells;
};

} // namespace filters
