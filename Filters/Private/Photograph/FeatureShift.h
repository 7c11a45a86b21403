// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How far features of a photograph lie from those of the simulated image.
#pragma once

#include "Photograph/CameraFit.h"
#include "Photograph/Plane.h"

namespace filters
{

/// A displacement at each point of an image, in points.
struct FeatureShift
{
  Plane right, up;
  /// The components across the features, NaN where there are none.
  Plane acrossRight, acrossUp;
};

/// Finds s with photograph(x + s) = simulated(x), up to a local brightness, by least squares in windows, from coarse to fine, on
/// about 400 points to a row (Lucas and Kanade 1981). Only the component across a feature is known. `known`: 1
/// where both are known.
FeatureShift shiftOfFeatures(const Plane& simulated, const Plane& photograph, const Plane& known);

/// Returns what is compared with the photographs pulled back by the shift, so that features lie where they are in the simulated image.
Exposure pulledBack(const Exposure& exposure, const FeatureShift& shift);

} // namespace filters
