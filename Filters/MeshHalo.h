// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Parts of one mesh on several ranks: each gets copies of the others' cells around the points that they have in common.
#pragma once

#include "DataParts.h"
#include "Vectors.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <vector>

class vtkUnstructuredGrid;

namespace refractivity
{

/// The meshes and curvilinear grids of an input as unstructured meshes; see partsOf(). False where there is other data.
bool areMeshes(vtkDataObject* data);
std::vector<Part> meshesOf(vtkDataObject* data, const std::vector<std::string>& arrays);

/// The points of a mesh that are on its surface: where another part may go on.
struct OuterPoints
{
  std::vector<vtkIdType> ids;
  std::vector<Point> places;
};
OuterPoints outerPointsOf(vtkUnstructuredGrid* mesh);

/// The cells at some points, and those at the points of these.
vtkSmartPointer<vtkUnstructuredGrid> cellsAround(
  vtkUnstructuredGrid* mesh, const std::vector<vtkIdType>& points);

/// A mesh and cells of others beside it, which become copies (DUPLICATECELL). Points that are the same to the last bit
/// become one. Throws std::runtime_error where the arrays are not the same.
vtkSmartPointer<vtkUnstructuredGrid> withCopies(
  vtkUnstructuredGrid* mesh, const std::vector<vtkSmartPointer<vtkDataSet>>& others);

} // namespace refractivity
