// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

class vtkImageData;

namespace filters
{

/// What an image with Refractivity says, as the tracer wants it.
schlieren::Grid gridFrom(vtkImageData* image);

/// All of the field that the image knows, with its arrays. Its masks have been merged.
schlieren::Field fieldFrom(vtkImageData* refractivity);

/// Makes one of an image's two masks, with the tracer's values. One that says gas everywhere is removed: it
/// would only take memory, a fifth of what is kept, and be read by the tracer.
void mergeMasks(vtkImageData* refractivity);

} // namespace filters
