// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/RefractivitySource.h"

/// The refractivity of an image, which keeps its own grid: nothing is interpolated.
namespace filters
{

/// Makes `structure` the grid of the image's points, or of the centres of its cells; of a flat image, two
/// such layers, `depth` apart (see depthOfImage()).
void gridOfImage(vtkImageData* image, bool ofCells, double depth, vtkImageData* structure);

/// Fills `output` from source.image.
Tally convertImage(const Source& source, Numbers numbers, vtkImageData* output);

} // namespace filters
