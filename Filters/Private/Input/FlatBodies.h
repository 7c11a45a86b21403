// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <functional>

class vtkDataObject;
class vtkPolyData;

/// Bodies in two-dimensional data.
namespace filters
{

/// Applies `change` to each surface among bodies.
vtkSmartPointer<vtkDataObject> changedBodies(
  vtkDataObject* bodies, const std::function<vtkSmartPointer<vtkPolyData>(vtkPolyData*)>& change);

/// Turns bodies to the axes of directionAcross() and extrudes those that lie in the plane. Null if there are none.
vtkSmartPointer<vtkDataObject> turnedBodies(vtkDataObject* bodies, int flat, double depth);

} // namespace filters
