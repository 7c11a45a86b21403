// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

class vtkImageData;

namespace filters
{

/// Returns what an image has at a place, fractions of its width and height, in lines: position, deflection, optical path
/// difference and intensity, in units that suit them. Empty beside the image.
std::string pixelInWords(vtkImageData* image, double right, double up);

} // namespace filters
