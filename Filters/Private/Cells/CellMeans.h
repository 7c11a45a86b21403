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

/// The mean over the cells around each point, NaN where there are none, of those that are `valid`. As the array that
/// `mesh` has its values from, which is filled here; fills `around`, where that is not null, for all points.
void setMeansAroundPoints(const MeshArrays& mesh, vtkDoubleArray* ofCells,
  vtkUnsignedCharArray* valid, vtkDoubleArray* ofPoints, std::vector<CellsAround>* around);

/// The same of a dataset with double scalars in its cells, those that are not hidden, and at its points. `areKept`: the
/// cells' values, and `around` as an array of the points; else the dataset has the means only.
void bringToPoints(vtkDataSet* data, bool areKept);

/// Name of the array of CellsAround, which MeshArrays reads.
constexpr const char* cellsAroundName = "CellsAround";
vtkSmartPointer<vtkDataArray> arrayOf(const std::vector<CellsAround>& around);

} // namespace filters
