// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RefractivitySource.h"

#include "vtkType.h"

/// Two-dimensional data: extruded by one data unit across their plane, half a unit to each side.
namespace refractivity
{

/// 0 to 3. vtkCellTypeUtilities::GetDimension makes a cell to ask it: for all cells of a mesh, that takes longer
/// than to resample it.
int dimensionOfCell(vtkDataSet* data, vtkIdType cell);

/// The coordinate axis (of an image: its own) across the plane in which all cells lie, -1 where there are
/// 3-D cells. Throws where there are neither: lines, points, tilted or curved surfaces.
int flatAxisOf(const Source& source);

/// What the user should hear of the extrusion.
std::string warningOfExtrusion(int flat);

/// Gives a grid of one layer a second one, one unit behind it.
void extrudeGrid(vtkImageData* grid, int flat);

/// Repeats the values of one layer in the second one.
void extrudeArrays(vtkImageData* image, int flat);

} // namespace refractivity
