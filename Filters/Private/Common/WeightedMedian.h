// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace filters
{

/// Of more values from the border of the data those of each nth cell or point do as well.
constexpr double mostOuterValues = 1e6;

struct WeightedValue
{
  double value, weight;
};

/// NaN where there are no values. Where half of the weight is below a value, up to rounding, the value below that.
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
