// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace filters
{

/// Maximum number of values from the data's border; of more, each nth is used.
constexpr double mostOuterValues = 1e6;

struct WeightedValue
{
  double value, weight;
};

/// Returns the first value up to which half of the weight lies; NaN without values.
inline double weightedMedian(std::vector<WeightedValue> parts)
{
  constexpr double rounding = 1e-9; // of sums in any order
  double all = 0;
  for (const WeightedValue& part : parts)
  {
    all += part.weight;
  }
  std::sort(parts.begin(), parts.end(),
    [](const WeightedValue& a, const WeightedValue& b) { return a.value < b.value; });
  double below = 0;
  for (const auto& [value, weight] : parts)
  {
    below += weight;
    if (below >= (0.5 - rounding) * all)
    {
      return value;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

} // namespace filters
