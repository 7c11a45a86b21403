// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Schlieren.h"

#include <string>

class vtkImageData;

namespace filters
{

/// Returns the length of the longest of an array of pairs; 0 if there are none.
double largestLength(const schlieren::PixelArray<float>& pairs);

/// Makes `output` the image with the arrays and field data that vtkSchlierenFilter promises, except
/// Color and Grid. Moves all of the image's arrays but `color`.
void setOutput(vtkImageData* output, schlieren::Image& image);

/// The mapping of light to the bytes of Color.
enum class ColorScale
{
  Linear,        ///< 1 is 255
  LinearToTwice, ///< shadowgraphs, whose undisturbed light is 1: 2 is 255
  Srgb           ///< true colours (IEC 61966-2-1): 1 is 255
};

/// Returns the byte of linear light.
unsigned char byteOf(float light, ColorScale scale);

/// Adds the colours of an image and makes them the scalars.
void addColor(vtkImageData* output, const schlieren::Image& image);

/// Adds spacing (data units) and angle (degrees) of finite fringes, and the wavelength (metres) of light that has only one.
void addFringes(vtkImageData* output, const schlieren::Scene& scene);

void addMedium(vtkImageData* output, const schlieren::MediumStatistics& medium);

/// Returns statistics as text: "1234 leaves on levels 1 to 5, ...".
std::string mediumInWords(const schlieren::MediumStatistics& medium);

/// Adds the medium in words.
void addGrid(vtkImageData* output, const char* grid);

/// Makes `output` the histogram: a point at each bin's deflection (u, v), with the array Rays.
/// Empty without a histogram.
void setHistogram(vtkImageData* output, const schlieren::Histogram& histogram);

} // namespace filters
