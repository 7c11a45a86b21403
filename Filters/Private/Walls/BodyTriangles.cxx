// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Walls/BodyTriangles.h"

#include "Input/InputDescription.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCleanPolyData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace filters
{

namespace
{

/// Lists the surfaces that have points.
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
  vtkNew<vtkCleanPolyData> used; // takes away points that no triangle has
  used->SetInputConnection(triangles->GetOutputPort());
  used->PointMergingOff();
  used->ConvertPolysToLinesOff();
  used->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  used->Update();
  requireFinite(used->GetOutput());
  return used->GetOutput();
}

} // namespace filters
