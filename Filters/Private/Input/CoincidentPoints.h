// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Vectors.h"

#include <cstdint>
#include <vector>

namespace filters
{

/// How far apart points may be that are one: 1e-3 of the smallest edge or cell beside each (infinite: none), and at least
/// what rounding may have moved them.
std::vector<double> mergingTolerances(
  const std::vector<Point>& points, const std::vector<double>& sizes, double rounding);

/// Which points are one, given how far apart they may be. Numbers of the points that stay.
std::vector<std::int32_t> coincidentPoints(
  const std::vector<Point>& points, const std::vector<double>& tolerances);

/// How far rounding may have moved points: of single precision where all coordinates fit into it.
double relativeRounding(const std::vector<Point>& points);

} // namespace filters
