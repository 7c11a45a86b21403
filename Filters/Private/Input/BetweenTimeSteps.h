// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

class vtkDataObject;

namespace filters
{

/// Interpolates data linearly in time, as vtkTemporalInterpolator does: real arrays, and points
/// that move with the mesh. All else, including integers such as masks and ghosts, comes from the
/// earlier step. `ratio`: 0 (earlier) ... 1 (later). Values equal in both steps stay exactly equal.
/// Null where both are null. Throws std::runtime_error that names the difference where cells,
/// blocks or grids differ.
vtkSmartPointer<vtkDataObject> betweenTimeSteps(
  vtkDataObject* earlier, vtkDataObject* later, double ratio);

} // namespace filters
