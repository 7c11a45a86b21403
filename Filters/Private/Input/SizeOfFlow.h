// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/Flow.h"

namespace filters
{

/// Relative to its largest difference from the surroundings, N of what counts as the flow in a
/// plane. Of 5 %, an aerofoil's flow is 1 to 1.6 chords high, a cylinder's 3.7 diameters; of 10 %, an
/// aerofoil's is 0.4 chords if it has a peak of suction; of 2 %, noise of 1 % fills the plane.
constexpr double leastOfFlow = 0.05;

/// Returns the shorter side of the box around the cells of a plane where N differs from its median
/// over the plane; 0 where it differs nowhere.
double sizeOfFlow(const Flow& flow, int flat);

} // namespace filters
