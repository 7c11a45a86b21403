// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/CellTypes.h"
#include "Input/Flow.h"
#include "Input/Remade.h"

#include "vtkBoundingBox.h"
#include "vtkType.h"

#include <array>

/// Extrudes two-dimensional data across their plane, half of the depth to each side.
namespace filters
{

/// Relative thickness of a plane that rounding in single precision explains.
constexpr double planeTolerance = 1e-6;

/// Returns 0 to 3. vtkCellTypeUtilities::GetDimension makes a cell for each call, which would take
/// longer than to resample the mesh.
int dimensionOfCell(vtkDataSet* data, vtkIdType cell);

/// Returns the largest dimension of the cells.
int dimensionOf(vtkDataSet* data);

/// Returns the bounds of all datasets of 2-D cells.
vtkBoundingBox boundsOfPlanes(const Flow& flow);

/// Returns the axis (of an image: its own) across the plane of all cells, or -1 if there are 3-D
/// cells. Throws for lines, points, and tilted or curved surfaces.
int flatAxisOf(const Flow& flow);

/// Returns the depth of flat data: the flow's, or the plane's shorter side. Throws if that is 0.
double depthOf(const Flow& flow, int flat);

/// Finds a depth: the plane's shorter side, or, with a far field, half of it, a quarter and so on, as
/// long as the flow is not larger.
void chooseDepth(Flow& flow, int flat);

/// Returns the depth of a flat image. `given`: 0 for the plane's shorter side.
double depthOfImage(vtkImageData* image, int flat, double given);

/// Returns a warning about an extrusion of unknown depth; empty if the user gave the depth.
std::string warningOfExtrusion(const Flow& flow, int flat);

/// Returns, by rows, the rotation that maps z to the axis across the plane and keeps the order of
/// the other axes; -1: the identity.
std::array<double, 9> directionAcross(int flat);

/// Transforms a point to these axes.
std::array<double, 3> turned(const double x[3], int flat);

/// Replaces flat cells by 3-D ones, in the axes of directionAcross().
Flow extruded(const Flow& flow, int flat, double depth);

/// Adds a second layer to a grid of one layer.
void extrudeGrid(vtkImageData* grid, int flat, double depth);

/// Repeats the values of one layer in the second one.
void extrudeArrays(vtkImageData* image, int flat);

} // namespace filters
