// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace refractivity
{

/**
 * Several points, each with its neighbours, and the quadratic polynomials that fit best what their values are, by least
 * squares: see PointNeighbours.
 */
struct PointFit
{
  static constexpr int points = 8; // at once

  /// Sets how many neighbours the points have at most, and that they have none as yet.
  void clear(std::size_t most);

  /// Adds one, counted from the point.
  void add(std::size_t point, const double x[3], double value)
  {
    double* to = this->numbers.data() + 4 * points * this->counts[point]++ + point;
    to[0] = x[0];
    to[points] = x[1];
    to[2 * points] = x[2];
    to[3 * points] = value;
  }

  std::size_t neighbours = 0; // of the point with most of them
  std::vector<double>
    numbers; // x, y, z and value of each neighbour, of all points at a time; else 0
  std::size_t counts[points] = {};

  // What is found of each point: 0 where there is no good gradient.
  double gradient[3][points];
  double unfit[points]; // the part of the values' squares that the polynomial leaves
  double lowest[points], highest[points]; // of the values and 0
};

/// Fits the polynomials of all points, each by itself, whatever the others are.
using FitPoints = void (*)(PointFit& fit);

/// For the instructions that this processor has, slower ones first.
std::vector<FitPoints> functionsToFit();

} // namespace refractivity
