// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// N of the gas around a flow, from what is at the boundary of the domain.
#pragma once

#include <vector>

namespace schlieren
{

/// N at a part of the boundary, and its area.
struct WeightedValue
{
  double value, weight;
};

/// Maximum number of values to take from a boundary; of more, each nth is used.
constexpr double mostOuterValues = 1e6;

/// Returns the first value up to which half of the weight lies; NaN without values.
double weightedMedian(std::vector<WeightedValue> values);

/// Returns N of the surroundings; NaN without values. It is the value that a quarter of the boundary or more has, and twice
/// as much of it as has any other: still gas, or an undisturbed inflow before shocks. Without such a value it is the median,
/// as a mean is pulled by every jet or wake that passes the boundary. Values count as one where they differ by less than 0.3 %
/// of their range, or, where that leaves half of them or more, by less than a tenth of that, and so on.
double ambientOf(std::vector<WeightedValue> values);

} // namespace schlieren
