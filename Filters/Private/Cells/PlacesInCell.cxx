// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/PlacesInCell.h"

#include <cstdint>
#include <cstring>
#include <limits>

namespace filters
{

namespace
{

// Steps of Newton's method, which converges quadratically.
constexpr int maxSteps = 15;
constexpr double lastStep = 1e-7;
constexpr double farthest = 1; // distance from the range
constexpr double nearlyAffine = 0.5;
constexpr double nothing = 1e-14; // residual, relative to the edges; holds in collapsed cells, too

#define SCHLIEREN_CODE_FOR_PACKS "PlacesInCell.inl"
#include "ForInstructions.inl"

} // namespace

std::vector<LocateInCell> functionsToLocate() { return SCHLIEREN_VARIANTS_OF(locate); }

} // namespace filters
