// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

class vtkImageData;

namespace schlieren
{
struct Histogram;
struct Image;
struct MediumStatistics;
} // namespace schlieren

namespace filters
{

/// Makes bounds infinite that say nothing of this image: of the displacement, if light from its middle might leave it;
/// of what skipping changes, if that might be as much as the largest deflection.
void dropIdleBounds(schlieren::Image& image);

/// Makes `output` the image `image`, with all arrays and field data that vtkSchlierenFilter promises
/// but Color, Grid and MediumDimensions, and without bounds that are infinite. Takes the memory of the image's arrays over, `color` excepted.
/// `isDifference`: see PathDifference.
void setOutput(vtkImageData* output, schlieren::Image& image, bool isDifference);

/// How the light of an image becomes the bytes of Color.
enum class ColorScale
{
  Linear,        ///< a tinted image: 1 is 255
  LinearToTwice, ///< of a shadowgraph, whose light is 1 where nothing bends it: 2 is 255
  Srgb           ///< colours to be seen as they are (IEC 61966-2-1): 1 is 255
};

/// Adds the colours of an image and makes them the scalars.
void addColor(vtkImageData* output, const schlieren::Image& image, ColorScale scale);

/// Adds the spacing of finite fringes, data units.
void addFringeSpacing(vtkImageData* output, double spacing);

/// Adds the interval of time that the image is the mean over.
void addExposure(vtkImageData* output, double begin, double end);

/// Adds what the medium of a mesh consists of.
void addMedium(vtkImageData* output, const schlieren::MediumStatistics& medium);

/// The same for people: "1234 leaves on levels 1 to 5, ...".
std::string mediumInWords(const schlieren::MediumStatistics& medium);

/// Adds what is known of the refractivity's grid: how it was chosen, and its points if it was resampled.
void addGrid(vtkImageData* output, const char* grid, vtkImageData* refractivity);

/// Makes `output` the histogram: a point at the centre of each bin, at its deflection along u and v, with the
/// array Rays. Empty where there is none.
void setHistogram(vtkImageData* output, const schlieren::Histogram& histogram);

} // namespace filters
