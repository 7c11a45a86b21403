// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/MeshArrays.h"
#include "Common/Vectors.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <vector>

class vtkDataArray;
class vtkDataSet;
class vtkDoubleArray;
class vtkUnsignedCharArray;
class vtkUnstructuredGrid;

namespace filters
{

/// The means of x and of (x - middle)(x - middle) over a cell.
struct CellMoments
{
  Vector middle;
  std::array<double, 6> second; // xx, yy, zz, xy, yz, zx
};

/// Returns the moments of a 3-D cell; of inverted and other cells, those of what they enclose.
CellMoments momentsOf(const MeshArrays& mesh, vtkIdType cell);

/// Returns the moments of a polyhedron.
CellMoments momentsOfPolyhedron(vtkUnstructuredGrid* mesh, vtkIdType cell);

/// Sets the array of `mesh`'s values to the means over the `valid` cells around each point, NaN
/// without any. Fills `around` for all points, if not null.
void setMeansAroundPoints(const MeshArrays& mesh, vtkDoubleArray* ofCells,
  vtkUnsignedCharArray* valid, vtkDoubleArray* ofPoints, std::vector<CellsAround>* around);

/// Averages the scalars (double) of a dataset's visible cells at its points. `areKept`: keeps the
/// cells' values, and adds `around` as an array of the points.
void bringToPoints(vtkDataSet* data, bool areKept);

/// Name of the array of CellsAround, which MeshArrays reads.
constexpr const char* cellsAroundName = "CellsAround";
vtkSmartPointer<vtkDataArray> arrayOf(const std::vector<CellsAround>& around);

} // namespace filters
