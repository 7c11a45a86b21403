// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityOfBodies.h"

#include "BodyVoxels.h"
#include "InputDescription.h"
#include "RefractivitySource.h"

#include "vtkAppendPolyData.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace filters
{

namespace
{

/// Bodies that are smaller, in voxels, or reach further beyond the data, have another unit of length.
constexpr double leastVoxels = 1e-3;
constexpr double mostVoxels = 1e9;

/// The surfaces with points.
std::vector<vtkPolyData*> surfacesOf(vtkDataObject* bodies)
{
  std::vector<vtkPolyData*> surfaces;
  for (vtkDataObject* leaf : leavesOf(bodies))
  {
    auto* surface = vtkPolyData::SafeDownCast(leaf);
    if (!surface)
    {
      throw std::runtime_error(std::string("The Bodies hold a ") + leaf->GetClassName() +
        ", but bodies are given by their surfaces. Put the filter Extract Surface before.");
    }
    if (surface->GetNumberOfPoints() > 0)
    {
      surfaces.push_back(surface);
    }
  }
  return surfaces;
}

void requireFinite(vtkPolyData* triangles)
{
  auto iterator = vtk::TakeSmartPointer(triangles->GetPolys()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* points;
    iterator->GetCurrentCell(count, points);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const double* x = triangles->GetPoint(points[i]);
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
      {
        throw std::runtime_error("The Bodies have points that are NaN or infinite, so nobody knows "
                                 "where they are. Check the program or filter that made them.");
      }
    }
  }
}

/// A coordinate in voxels, to 1/4096. Walls often go through points of the grid, but for rounding, which
/// would leave some of these points inside and others outside; now they all lie on the wall.
double rounded(double x)
{
  constexpr double parts = 4096;
  return std::round(parts * x) / parts;
}

/// A place in index coordinates of the grid, counted from its first point; 0 where that has no size.
Point onGrid(const Point& place, vtkImageData* grid)
{
  const int* extent = grid->GetExtent();
  Point x;
  grid->TransformPhysicalPointToContinuousIndex(place.data(), x.data());
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    x[axis] = std::isfinite(x[axis]) ? rounded(x[axis] - extent[2 * axis]) : 0;
  }
  return x;
}

vtkBoundingBox boundsOf(const std::vector<Point>& points)
{
  vtkBoundingBox bounds;
  for (const Point& x : points)
  {
    bounds.AddPoint(x[0], x[1], x[2]);
  }
  return bounds;
}

} // namespace

vtkSmartPointer<vtkPolyData> trianglesOfBodies(vtkDataObject* bodies)
{
  vtkNew<vtkAppendPolyData> append;
  for (vtkPolyData* data : surfacesOf(bodies))
  {
    vtkNew<vtkPolyData> polygons;
    polygons->SetPoints(data->GetPoints());
    polygons->SetPolys(data->GetPolys());
    polygons->SetStrips(data->GetStrips());
    append->AddInputData(polygons);
  }
  if (append->GetNumberOfInputConnections(0) == 0)
  {
    throw std::runtime_error(
      "The Bodies are empty: they have no points. Check that their source was "
      "read or updated, or take the input away.");
  }
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(append->GetOutputPort());
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  triangles->Update();
  if (triangles->GetOutput()->GetNumberOfPolys() == 0)
  {
    throw std::runtime_error(
      "The Bodies have no polygons, only points or lines, which stop no light. Give surfaces, for "
      "instance from the filter Extract Surface, or take the input away.");
  }
  requireFinite(triangles->GetOutput());
  return triangles->GetOutput();
}

std::string placeBodies(vtkDataObject* bodies, vtkImageData* output)
{
  const BodySurfaces surfaces(
    bodies, [output](const Point& place) { return onGrid(place, output); });
  const vtkBoundingBox bounds = boundsOf(surfaces.surface().points);
  std::array<int, 3> dimensions;
  output->GetDimensions(dimensions.data());
  double most = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = bounds.GetMinPoint()[axis], high = bounds.GetMaxPoint()[axis];
    if (low > dimensions[static_cast<std::size_t>(axis)] || high < -1)
    {
      return bodiesAreOutside;
    }
    most = std::max({ most, -low, high });
  }
  if (most > mostVoxels)
  {
    throw std::runtime_error("The Bodies reach more than 10^9 voxels beyond the data. Do both have "
                             "the same unit of length?");
  }
  if (bounds.GetDiagonalLength() < leastVoxels)
  {
    return "The Bodies are smaller than a thousandth of a voxel, so they stop no light. Do both "
           "have the same unit of length?";
  }

  vtkPointData* arrays = output->GetPointData();
  std::vector<vtkDataArray*> cleared = { arrays->GetArray(arrayName), arrays->GetArray(maskName) };
  if (vtkDataArray* transparent = arrays->GetArray(transparentName))
  {
    cleared.push_back(transparent);
  }
  bool isMet = false;
  voxelize(surfaces, dimensions,
    [&](int i, int j, int k)
    {
      isMet = true;
      const vtkIdType at = (static_cast<vtkIdType>(k) * dimensions[1] + j) * dimensions[0] + i;
      for (vtkDataArray* array : cleared)
      {
        array->SetComponent(at, 0, 0);
      }
    });
  return isMet ? "" : bodiesAreOutside;
}

} // namespace filters
