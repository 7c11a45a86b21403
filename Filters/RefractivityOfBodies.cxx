// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityOfBodies.h"

#include "BodyVoxels.h"
#include "InputDescription.h"
#include "RefractivitySource.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataConnectivityFilter.h"
#include "vtkSmartPointer.h"
#include "vtkStaticCleanPolyData.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace filters
{

namespace
{

/// Points nearer to each other than this are one, so that surfaces that were written in single precision or
/// face by face are closed.
constexpr double mergingVoxels = 1e-4;

/// Further away from the data, in voxels, VTK cannot merge points: it would crash.
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

/// The same triangles in index coordinates of the grid, counted from its first point.
vtkSmartPointer<vtkPolyData> onGrid(vtkPolyData* triangles, vtkImageData* grid)
{
  const int* extent = grid->GetExtent();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(triangles->GetNumberOfPoints());
  for (vtkIdType i = 0; i < triangles->GetNumberOfPoints(); ++i)
  {
    double x[3];
    grid->TransformPhysicalPointToContinuousIndex(triangles->GetPoint(i), x);
    const bool isFinite = std::all_of(x, x + 3, [](double index) { return std::isfinite(index); });
    if (!isFinite) // no triangle has it, or the grid has no size
    {
      std::fill_n(x, 3, 0.);
    }
    points->SetPoint(i, x[0] - extent[0], x[1] - extent[2], x[2] - extent[4]);
  }
  auto moved = vtkSmartPointer<vtkPolyData>::New();
  moved->SetPoints(points);
  moved->SetPolys(triangles->GetPolys());
  return moved;
}

/// Whether bodies lie beside the grid. Throws where they reach much further than that.
bool isBeside(vtkPolyData* moved, const std::array<int, 3>& dimensions)
{
  double bounds[6];
  moved->GetBounds(bounds);
  double most = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (bounds[2 * axis] > dimensions[axis] || bounds[2 * axis + 1] < -1)
    {
      return true;
    }
    most = std::max({ most, -bounds[2 * axis], bounds[2 * axis + 1] });
  }
  if (most > mostVoxels)
  {
    throw std::runtime_error("The Bodies reach more than 10^9 voxels beyond the data. Do both have "
                             "the same unit of length?");
  }
  return false;
}

/// A coordinate in voxels, to 1/4096. Walls often go through points of the grid, but for rounding, which
/// would leave some of these points inside and others outside; now they all lie on the wall.
double rounded(double x)
{
  constexpr double parts = 4096;
  return std::round(parts * x) / parts;
}

/// Polygons, and which of the connected parts each of their points belongs to.
vtkSmartPointer<vtkPolyData> labelParts(vtkPolyData* triangles)
{
  vtkNew<vtkStaticCleanPolyData> merge;
  merge->SetInputData(triangles);
  merge->ToleranceIsAbsoluteOn();
  merge->SetAbsoluteTolerance(mergingVoxels);
  merge->ConvertPolysToLinesOff();
  merge->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkPolyDataConnectivityFilter> label;
  label->SetInputConnection(merge->GetOutputPort());
  label->SetExtractionModeToAllRegions();
  label->ColorRegionsOn();
  label->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  label->Update();
  merge->SetMergingArray(nullptr); // its destructor forgets it
  return label->GetOutput();
}

/// The triangles of each part.
std::vector<std::vector<Surface::Triangle>> partsOf(vtkPolyData* labelled)
{
  std::vector<std::vector<Surface::Triangle>> parts;
  vtkDataArray* labels = labelled->GetPointData()->GetArray("RegionId");
  auto iterator = vtk::TakeSmartPointer(labelled->GetPolys()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* points;
    iterator->GetCurrentCell(count, points);
    if (count == 3)
    {
      const auto part = static_cast<std::size_t>(labels->GetComponent(points[0], 0));
      parts.resize(std::max(parts.size(), part + 1));
      Surface::Triangle triangle;
      std::copy_n(points, 3, triangle.begin());
      parts[part].push_back(triangle);
    }
  }
  return parts;
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
  const auto triangles = trianglesOfBodies(bodies);
  const auto moved = onGrid(triangles, output);
  std::array<int, 3> dimensions;
  output->GetDimensions(dimensions.data());
  if (isBeside(moved, dimensions))
  {
    return bodiesAreOutside;
  }
  if (moved->GetLength() < 10 * mergingVoxels) // VTK crashes where all points are one
  {
    return "The Bodies are smaller than a thousandth of a voxel, so they stop no light. Do both "
           "have "
           "the same unit of length?";
  }
  const auto labelled = labelParts(moved);
  std::vector<std::array<double, 3>> points(
    static_cast<std::size_t>(labelled->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    labelled->GetPoint(static_cast<vtkIdType>(i), points[i].data());
    std::transform(points[i].begin(), points[i].end(), points[i].begin(), rounded);
  }

  vtkPointData* arrays = output->GetPointData();
  std::vector<vtkDataArray*> cleared = { arrays->GetArray(arrayName), arrays->GetArray(maskName) };
  if (vtkDataArray* transparent = arrays->GetArray(transparentName))
  {
    cleared.push_back(transparent);
  }
  bool isMet = false;
  // Each part on its own, so that bodies may overlap or enclose each other.
  for (std::vector<Surface::Triangle>& part : partsOf(labelled))
  {
    voxelize({ points, std::move(part) }, dimensions,
      [&](int i, int j, int k)
      {
        isMet = true;
        const vtkIdType at = (static_cast<vtkIdType>(k) * dimensions[1] + j) * dimensions[0] + i;
        for (vtkDataArray* array : cleared)
        {
          array->SetComponent(at, 0, 0);
        }
      });
  }
  return isMet ? "" : bodiesAreOutside;
}

} // namespace filters
