// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// A photograph as it is read, and what it has at the points of the image.
#pragma once

#include "Photograph/CameraFit.h"
#include "Photograph/Placing.h"

#include <vector>

class vtkImageData;
struct PhotographSettings;

namespace filters
{

/// A photograph in its own pixels, or in squares of them where they are finer than the image's.
struct Photograph
{
  Plane values;
  Plane withoutFlow; // or empty
  Plane used;        // 1 within the mirror where it is not saturated, else 0
  Grid grid;
  double black = 0;
  bool isBlackKnown = false; // given, or seen beyond the mirror
};

/// Returns where the settings place the photograph.
Place placeOf(const Grid& image, const Grid& photograph, const PhotographSettings& settings);

/// Reads a photograph, means over squares of `factor` pixels. `withoutFlow` may be null. Throws std::runtime_error where they do
/// not fit each other.
Photograph readPhotograph(vtkImageData* photograph, vtkImageData* withoutFlow, int factor,
  const PhotographSettings& settings);

/// Returns the photographs at the image's points. `open`: 1 where no ray has ended in a solid.
Exposure exposureOf(
  const Photograph& photograph, const Place& place, const Grid& image, const Plane& open);

/// Returns the values where both are known.
std::vector<float> knownValues(const Plane& plane, const Plane& known);

} // namespace filters
