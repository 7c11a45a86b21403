// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// A photograph: its values, where it lies in the plane of the simulated image, and what it has at that image's points.
#pragma once

#include "Photograph/Plane.h"

#include <array>

class vtkImageData;

namespace filters
{

using Point2 = std::array<double, 2>;

/// A similarity from the photograph's coordinates (pixels, of image files) to those of the image (data units).
struct Place
{
  Point2 anchor{};     ///< in the photograph
  Point2 position{};   ///< of the anchor in the image
  double scale = 1;    ///< data units per unit of the photograph, upward
  double rotation = 0; ///< radians, to the left
  double aspect = 1;   ///< width over height of the photograph's pixels

  Point2 inImage(const Point2& ofPhotograph) const;
  Point2 inPhotograph(const Point2& ofImage) const;
};

/// Returns the place by which two points of the photograph lie at two of the image. Throws std::runtime_error where two are one.
Place placeByPoints(
  const Point2& from1, const Point2& from2, const Point2& to1, const Point2& to2, double aspect);

/// A plane and where its points lie: those of the image, or those of a photograph in its own coordinates.
struct Grid
{
  Grid() = default;
  explicit Grid(vtkImageData* image);

  Point2 at(double column, double row) const
  {
    return { origin[0] + column * spacing[0], origin[1] + row * spacing[1] };
  }
  Point2 middle() const { return at(0.5 * (columns - 1), 0.5 * (rows - 1)); }

  int columns = 0;
  int rows = 0;
  Point2 origin{};
  Point2 spacing{ 1, 1 };
};

/// Returns the value that is 1 in photographs of an exposure: the largest that the fewest even number of bits has which
/// hold all the values of both (8 for bytes), 1 for floating-point values up to 1. `other` may be null.
double whiteOf(vtkImageData* photograph, vtkImageData* other);

/// Luminance (ITU-R BT.709; of two components the first, a fourth is left out) over white, means over squares of
/// `factor` pixels. Throws std::runtime_error where there are no values. `grid`: where its points are.
Plane luminanceOf(vtkImageData* photograph, double white, int factor, Grid& grid);

/// Returns the values at the points of the image, between those of the photograph; NaN beyond it. As vtkImageReslice has them.
Plane resampled(const Plane& photograph, const Grid& from, const Place& place, const Grid& image);

} // namespace filters
