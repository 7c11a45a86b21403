// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Parts of one mesh on several ranks: each gets copies of the others' cells around the points that they have in common.
#pragma once

#include "DataParts.h"
#include "Vectors.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <functional>
#include <vector>

class vtkUnstructuredGrid;

namespace refractivity
{

/// The meshes and curvilinear grids of an input as unstructured meshes; see partsOf(). False where there is other data.
bool areMeshes(vtkDataObject* data);
std::vector<Part> meshesOf(vtkDataObject* data, const std::vector<std::string>& arrays);

/// Points on several ranks are one if both are the same: their places, and their indices in a curvilinear grid or, in
/// other meshes, how many points before them are at that place.
struct PointName
{
  Point place, number;
};
inline bool operator==(const PointName& a, const PointName& b)
{
  return a.place == b.place && a.number == b.number;
}

/// The points of a mesh of meshesOf() that are on its surface: where another part may go on.
struct OuterPoints
{
  std::vector<vtkIdType> ids;
  std::vector<PointName> names;
};
OuterPoints outerPointsOf(vtkUnstructuredGrid* mesh);

struct HashOfPlace
{
  std::size_t operator()(const Point& place) const
  {
    std::size_t sum = 0;
    for (const double x : place)
    {
      sum = 1000003 * sum + std::hash<double>()(x);
    }
    return sum;
  }
  std::size_t operator()(const PointName& name) const { return (*this)(name.place); }
};

/// The cells at some points, those at the points of these, and as many more layers as other points' values depend on.
vtkSmartPointer<vtkUnstructuredGrid> cellsAround(
  vtkUnstructuredGrid* mesh, const std::vector<vtkIdType>& points);

/// A mesh and cells of others beside it, which become copies (DUPLICATECELL). Points with the same name become one.
/// Throws std::runtime_error where the arrays are not the same.
vtkSmartPointer<vtkUnstructuredGrid> withCopies(
  vtkUnstructuredGrid* mesh, const std::vector<vtkSmartPointer<vtkDataSet>>& others);

} // namespace refractivity
