// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Vectors.h"

#include <cstdint>
#include <vector>

namespace filters
{

/// Returns the distance within which a point coincides with others: 1e-3 of the smallest edge or
/// cell beside it (infinite: none), but at least the rounding of coordinates.
std::vector<double> mergingTolerances(
  const std::vector<Point>& points, const std::vector<double>& sizes, double rounding);

/// Maps each point to the one that represents all that coincide with it.
std::vector<std::int32_t> coincidentPoints(
  const std::vector<Point>& points, const std::vector<double>& tolerances);

/// Returns the relative rounding of coordinates: that of single precision where all fit into it.
double relativeRounding(const std::vector<Point>& points);

} // namespace filters
