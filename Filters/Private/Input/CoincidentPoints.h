// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Vectors.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace filters
{

/// Classes of numbers that have been said to be equal.
class Classes
{
public:
  explicit Classes(std::size_t count)
    : Roots(count)
  {
    std::iota(this->Roots.begin(), this->Roots.end(), std::size_t{ 0 });
  }
  std::size_t rootOf(std::size_t i)
  {
    while (this->Roots[i] != i)
    {
      i = this->Roots[i] = this->Roots[this->Roots[i]];
    }
    return i;
  }
  /// The lower one stays.
  void join(std::size_t a, std::size_t b)
  {
    const auto [low, high] = std::minmax({ this->rootOf(a), this->rootOf(b) });
    this->Roots[high] = low;
  }

private:
  std::vector<std::size_t> Roots;
};

/// Maps each point to the first one that represents all that coincide with it: equal ones, and
/// those within 1e-3 of the smaller of their `sizes` (of the smallest edge or cell beside a point;
/// infinite: none), or within the rounding of coordinates. No distance holds for all points, since
/// layers at walls may be thinner than that.
std::vector<std::int32_t> coincidentPoints(
  const std::vector<Point>& points, const std::vector<double>& sizes);

/// Returns the relative rounding of coordinates: that of single precision where all fit into it.
double relativeRounding(const std::vector<Point>& points);

} // namespace filters
