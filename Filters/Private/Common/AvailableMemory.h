// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkType.h"

#include <string>

class vtkAbstractArray;

namespace filters
{

/// Returns the bytes that the machine and the process's control group leave; infinite where the
/// system does not report them.
double availableMemory();

/// Throws std::runtime_error if so many bytes are not available, or not granted to the process. Call it before allocating arrays,
/// because VTK may be built to abort when an allocation fails, as Debian's is. `what` begins the
/// message, `remedy` ends it.
void requireMemory(double bytes, const std::string& what, const std::string& remedy);

/// Calls SetNumberOfTuples(), or throws std::bad_alloc where memory does not suffice.
void setTuples(vtkAbstractArray* array, vtkIdType tuples);

} // namespace filters
