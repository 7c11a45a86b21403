// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RefractivitySource.h"

#include "vtkType.h"

#include <array>
#include <functional>

class vtkPolyData;

/// Two-dimensional data: extruded by one data unit across their plane, half a unit to each side.
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

/// What the user should hear of the extrusion.
std::string warningOfExtrusion(int flat);

/// The points along each axis of data whose cells are numbered by three indices; 0 of others.
std::array<int, 3> structureOf(vtkDataSet* data);

/// By rows, the rotation from axes in which the data's plane is across z to the data's own; -1: none. Of the other two
/// axes, the order stays.
std::array<double, 9> directionAcross(int flat);

/// The source with 3-D cells in place of flat ones, in the axes of directionAcross().
Source extruded(const Source& source, int flat);

/// What `change` makes of each surface among bodies.
vtkSmartPointer<vtkDataObject> changedBodies(
  vtkDataObject* bodies, const std::function<vtkSmartPointer<vtkPolyData>(vtkPolyData*)>& change);

/// Bodies in these axes; those that lie in the plane are extruded, too. Null: there are none.
vtkSmartPointer<vtkDataObject> turnedBodies(vtkDataObject* bodies, int flat);

/// Gives a grid of one layer a second one, one unit behind it.
void extrudeGrid(vtkImageData* grid, int flat);

/// Repeats the values of one layer in the second one.
void extrudeArrays(vtkImageData* image, int flat);

} // namespace filters
