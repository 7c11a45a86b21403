// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkImageData;

namespace schlieren
{
struct Image;
}

/// Makes `output` the picture `image`, with all arrays and field data that vtkSchlierenFilter promises
/// but Color, Grid and MediumDimensions. Takes the memory of the image's arrays over, `color` excepted.
void setOutput(vtkImageData* output, schlieren::Image& image);

/// Adds the colours of a tinted picture, of which `white` is white, and makes them the scalars.
void addColor(vtkImageData* output, const schlieren::Image& image, float white);

/// Adds what is known of the refractivity's grid: how it was chosen, and its points if it was resampled.
void addGrid(vtkImageData* output, const char* grid, vtkImageData* refractivity);
