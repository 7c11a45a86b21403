// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

class vtkImageData;

namespace filters
{

/// Converts an image's geometry to the tracer's.
schlieren::Grid gridFrom(vtkImageData* image);

/// Wraps the image's arrays as the tracer's field. mergeMasks() has been called.
schlieren::Field fieldFrom(vtkImageData* refractivity);

/// Merges an image's two masks into one with the tracer's values. Removes a mask that is gas
/// everywhere: it would cost memory (a fifth of the image's) and time.
void mergeMasks(vtkImageData* refractivity);

} // namespace filters
