// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The pixels of an image that a beam covers.
#pragma once

#include <vector>

class vtkImageData;

namespace filters
{

/// Those of vtkWavefront.
enum class ApertureShape
{
  Round = 0,
  Square = 1
};

/// Lengths are in pixels; the middle of the first pixel is at column 0 and row 0.
struct Aperture
{
  ApertureShape shape = ApertureShape::Round;
  double column = 0; ///< of its middle
  double row = 0;
  double diameter = 0; ///< of a square: its side

  /// Returns whether the middle of a pixel is in the aperture.
  bool has(int ofColumn, int ofRow) const;
};

/// Which pixels of an image have light through the data, row by row.
struct LitPixels
{
  int columns = 0;
  int rows = 0;
  std::vector<unsigned char> isLit;
};

/**
 * Finds the pixels whose light has come through the data: the path is finite, nothing is blocked, and the pixel is not beside
 * the data. Where light has met nothing that changes its path, the path is 0: beside the data, and in still gas. Still gas
 * is what has light with a path, or a body, on both sides in its row and in its column.
 *
 * `path`: the image's OpticalPathDifference, row by row. BlockedFraction of the image is taken where it is there.
 */
LitPixels litPixelsOf(vtkImageData* image, const std::vector<double>& path);

/// Returns the largest aperture of lit pixels; of several, the one closest to the image's middle. Its diameter is 0 where
/// no pixel is lit. A round one ends where the first pixel that is not lit begins, or the image ends.
Aperture largestAperture(const LitPixels& pixels, ApertureShape shape);

} // namespace filters
