// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The place of a photograph by what is in it.
#pragma once

#include "Photograph/Placing.h"
#include "Photograph/Plane.h"

namespace filters
{

/// Returns 1 where a photograph has more than half of the light around it, else 0: not in a body. Half the light is
/// `black` + 1/2^exponent of the brightness, which is the 60th percentile of a window as wide as a quarter of the photograph.
Plane lightOrNone(const Plane& photograph, double black, double exponent);

enum class FreePlace
{
  RotationAndPosition,
  ScaleToo
};

/// Moves, turns and, if it may, scales a photograph to where its values are those of an image, both smoothed less and less: over
/// 12, 4 and 1.5 points of the photograph. `used`: 1 at points of the photograph that count. By Levenberg's and Marquardt's
/// method with the robust loss of fitCamera(), s = 0.1.
Place fittedPlace(const Place& start, FreePlace free, const Plane& photograph, const Plane& used,
  const Grid& ofPhotograph, const Plane& image, const Grid& ofImage);

} // namespace filters
