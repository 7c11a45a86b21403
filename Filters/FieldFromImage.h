// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <vector>

class vtkImageData;

/// What an image with Refractivity and its masks says, as the tracer wants it.
schlieren::Grid gridFrom(vtkImageData* image);

/// All of the field that the image knows. Its arrays are those of the image, or `mask`, which has to live
/// as long.
schlieren::Field fieldFrom(vtkImageData* refractivity, std::vector<unsigned char>& mask);

/// Removes a mask that says gas everywhere: it would only take memory, a fifth of what is held, and be
/// read by the tracer.
void dropMaskOfOnes(vtkImageData* refractivity);
