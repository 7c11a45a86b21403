// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkType.h"

#include <string>

class vtkAbstractArray;

namespace filters
{

/// Bytes that this process can still have: what the machine and the limits of the process and its control group leave;
/// infinite where the system does not say.
double availableMemory();

/// Throws std::runtime_error where so many bytes cannot be had. VTK may be built to abort where an array does not fit, as
/// Debian's is, so this comes before the arrays are made. `what` begins the message, `remedy` ends it.
void requireMemory(double bytes, const std::string& what, const std::string& remedy);

/// SetNumberOfTuples() that throws std::bad_alloc where there is no memory for them.
void setTuples(vtkAbstractArray* array, vtkIdType tuples);

} // namespace filters
