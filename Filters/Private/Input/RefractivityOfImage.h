// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/RefractivitySource.h"

/// Converts the refractivity of an image on its own grid, without interpolation.
namespace filters
{

/// Makes `structure` the grid of the image's points or cell centres; of a flat image, two layers
/// `depth` apart (see depthOfImage()).
void gridOfImage(vtkImageData* image, bool ofCells, double depth, vtkImageData* structure);

/// Fills `output` from source.image.
Tally convertImage(const Source& source, Numbers numbers, vtkImageData* output);

} // namespace filters
