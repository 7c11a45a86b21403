// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <string>

class vtkDataObject;
class vtkImageData;
class vtkPolyData;

/// Converts bodies in the gas, given as surfaces.
namespace filters
{

/// Warning about bodies outside of the data.
constexpr const char* bodiesAreOutside =
  "The Bodies lie outside the data, so they stop no light. Do both have the same unit "
  "of length and the same origin?";
/// Error if bodies cover all data.
constexpr const char* bodiesCoverAll =
  "The Bodies cover all of the gas, so there is none for light to "
  "cross. Leave out what encloses the flow. Do both have the same unit of length?";

/// Returns the polygons of `bodies` as triangles. Throws std::runtime_error if they are no surfaces
/// (vtkPolyData, or a composite of it) or have points that are not finite.
vtkSmartPointer<vtkPolyData> trianglesOfBodies(vtkDataObject* bodies);

} // namespace filters
