// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Vectors.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace filters
{

/// Numbers that become equal.
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
