// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/RefractivitySource.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkType.h"

#include <array>
#include <functional>

class vtkPolyData;

/// Two-dimensional data: extruded across their plane, half of their depth to each side.
namespace filters
{

/// 0 to 3. vtkCellTypeUtilities::GetDimension makes a cell to query it: for all cells of a mesh, that takes longer
/// than to resample it.
int dimensionOfCell(vtkDataSet* data, vtkIdType cell);

/// The largest of its cells' dimensions.
int dimensionOf(vtkDataSet* data);

/// The coordinate axis (of an image: its own) across the plane in which all cells lie, -1 where there are
/// 3-D cells. Throws where there are neither: lines, points, tilted or curved surfaces.
int flatAxisOf(const Source& source);

/// How deep flat data become: as the source says, or as the plane's shorter side is long. Throws where that is 0.
double depthOf(const Source& source, int flat);

/// The same of an image alone. `given`: 0 where the depth is to be chosen.
double depthOfImage(vtkImageData* image, int flat, double given);

/// What the user should hear of the extrusion.
std::string warningOfExtrusion(const Source& source, int flat);

/// The points along each axis of data whose cells are numbered by three indices; 0 of others.
std::array<int, 3> structureOf(vtkDataSet* data);

/// By rows, the rotation from axes in which the data's plane is across z to the data's own; -1: none. Of the other two
/// axes, the order stays.
std::array<double, 9> directionAcross(int flat);

/// What is made of a leaf, and of which of its points and cells.
struct Remade
{
  vtkSmartPointer<vtkDataSet> data;
  vtkNew<vtkIdList> points, cells;

  /// As a leaf: with the values and what hides them.
  Leaf leafOf(const Leaf& from) const;
};

/// The source with 3-D cells in place of flat ones, in the axes of directionAcross().
Source extruded(const Source& source, int flat, double depth);

/// What `change` makes of each surface among bodies.
vtkSmartPointer<vtkDataObject> changedBodies(
  vtkDataObject* bodies, const std::function<vtkSmartPointer<vtkPolyData>(vtkPolyData*)>& change);

/// Bodies in these axes; those that lie in the plane are extruded, too. Null: there are none.
vtkSmartPointer<vtkDataObject> turnedBodies(vtkDataObject* bodies, int flat, double depth);

/// Gives a grid of one layer a second one, behind it.
void extrudeGrid(vtkImageData* grid, int flat, double depth);

/// Repeats the values of one layer in the second one.
void extrudeArrays(vtkImageData* image, int flat);

} // namespace filters
