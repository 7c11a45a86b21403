// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/PlacesInPart.h"

#include <cstdint>
#include <cstring>
#include <limits>

namespace filters
{

namespace
{

// Steps of Newton's method, which converges quadratically.
constexpr int maxSteps = 12;
constexpr double lastStep = 1e-7;
constexpr double maxWithoutGain = 4; // steps that do not halve the least residual so far
constexpr double farthest = 1.5;     // from the middle, in coordinates of the part
// Residuals; those of folded and collapsed parts fall more slowly.
constexpr double nothing = 1e-14, nothingInFolds = 1e-11;

// Starts in parts that are folded or collapsed.
constexpr int attempts = 2;
constexpr double starts[attempts][3] = { { 0, 0, 0 }, { 0.6, 0.5, -0.4 } };

#define SCHLIEREN_CODE_FOR_PACKS "PlacesInPart.inl"
#include "ForInstructions.inl"

} // namespace

std::vector<LocateInPart> functionsToLocateInPart() { return SCHLIEREN_VARIANTS_OF(locate); }

} // namespace filters
