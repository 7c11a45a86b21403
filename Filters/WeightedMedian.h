// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace filters
{

/// Of values, each with its weight; NaN where there are none.
inline double weightedMedian(std::vector<std::pair<double, double>> parts)
{
  double all = 0;
  for (const auto& part : parts)
  {
    all += part.second;
  }
  std::sort(parts.begin(), parts.end());
  double below = 0;
  for (const auto& [value, weight] : parts)
  {
    below += weight;
    if (below >= 0.5 * all)
    {
      return value;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

} // namespace filters
