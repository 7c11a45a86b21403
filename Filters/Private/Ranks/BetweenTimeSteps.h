// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

class vtkDataObject;

namespace filters
{

/// Data between two time steps, linear in time as those of vtkTemporalInterpolator: arrays of real numbers, and points
/// that move with the mesh. Everything else, arrays of integers such as masks and ghosts included, is of the earlier
/// step. `ratio`: 0 (earlier) ... 1 (later). Points that are the same in both steps stay as they are, to the last bit, so
/// that the mesh is known again. Null where both are null. Throws std::runtime_error, which says what differs, where cells,
/// blocks or grids do.
vtkSmartPointer<vtkDataObject> betweenTimeSteps(
  vtkDataObject* earlier, vtkDataObject* later, double ratio);

} // namespace filters
