// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/Flow.h"

/// Converts the refractivity of an image on its own grid, without interpolation.
namespace filters
{

/// Makes `structure` the grid of the image's points or cell centres; of a flat image, two layers
/// `depth` apart (see depthOfImage()).
void gridOfImage(vtkImageData* image, bool ofCells, double depth, vtkImageData* structure);

/// Fills `output` from flow.image.
Tally convertImage(const Flow& flow, Numbers numbers, vtkImageData* output);

} // namespace filters
