// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/FlatBodies.h"

#include "Input/FlatData.h"
#include "Input/InputDescription.h"

#include "vtkBoundingBox.h"
#include "vtkLinearExtrusionFilter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <array>

namespace filters
{

namespace
{

/// Turns a surface to the axes of directionAcross(), and extrudes one that lies in the plane.
vtkSmartPointer<vtkPolyData> turnedSurface(vtkPolyData* surface, int flat, double depth)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(surface);
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  double bounds[6];
  surface->GetBounds(bounds);
  vtkBoundingBox box(bounds);
  const bool isPlane =
    box.GetLength(flat) <= planeTolerance * box.GetMaxLength() && surface->GetNumberOfPolys() > 0;
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    double x[3];
    surface->GetPoint(point, x);
    const std::array<double, 3> own = turned(x, flat);
    places->InsertNextPoint(own[0], own[1], own[2] - (isPlane ? depth : 0));
  }
  result->SetPoints(places);
  if (!isPlane)
  {
    return result;
  }
  vtkNew<vtkLinearExtrusionFilter> prism;
  prism->SetInputData(result);
  prism->SetExtrusionTypeToVectorExtrusion();
  prism->SetVector(0, 0, 2 * depth);
  prism->CappingOn();
  prism->Update();
  return prism->GetOutput();
}

} // namespace

vtkSmartPointer<vtkDataObject> changedBodies(
  vtkDataObject* bodies, const std::function<vtkSmartPointer<vtkPolyData>(vtkPolyData*)>& change)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (vtkDataObject* leaf : leavesOf(bodies))
  {
    auto* surface = vtkPolyData::SafeDownCast(leaf);
    if (!surface)
    {
      return bodies; // their reader reports the error
    }
    blocks->SetBlock(blocks->GetNumberOfBlocks(), change(surface));
  }
  return blocks;
}

vtkSmartPointer<vtkDataObject> turnedBodies(vtkDataObject* bodies, int flat, double depth)
{
  return bodies && flat >= 0
    ? changedBodies(
        bodies, [flat, depth](vtkPolyData* surface) { return turnedSurface(surface, flat, depth); })
    : vtkSmartPointer<vtkDataObject>(bodies);
}

} // namespace filters
