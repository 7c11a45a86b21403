// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace filters
{

/**
 * Several points, each with its neighbours, and the quadratic polynomials that fit best what their values are, by least
 * squares: see PointNeighbours.
 *
 * Values are those at the points, or means over some volume around each of them, whose moments are known (see
 * CellsAround): then the polynomials' means over these volumes are what fits the values.
 */
struct PointFit
{
  static constexpr int points = 8; // per fit
  enum class Values
  {
    AtPoints,
    Means
  };

  /// Removes all neighbours. `most`: maximum number for each point.
  void clear(std::size_t most, Values values = Values::AtPoints);

  /// Adds a neighbour, relative to the point.
  void add(std::size_t point, const double x[3], double value)
  {
    double* to = this->numbers.data() + this->perNeighbour * points * this->counts[point]++ + point;
    to[0] = x[0];
    to[points] = x[1];
    to[2 * points] = x[2];
    to[3 * points] = value;
  }

  /// Of means: adds one with its first and second moments (xx, yy, zz, xy, yz, zx) around the point, both less those
  /// of the point's own mean.
  void add(std::size_t point, const double first[3], const double second[6], double value)
  {
    double* to =
      this->numbers.data() + (this->perNeighbour * this->counts[point] + 4) * points + point;
    for (int i = 0; i < 6; ++i)
    {
      to[i * points] = second[i];
    }
    this->add(point, first, value);
  }

  Values values = Values::AtPoints;
  std::size_t neighbours = 0;   // maximum of all points
  std::size_t perNeighbour = 4; // numbers
  std::vector<double>
    numbers; // x, y, z, value (and second moments) of each neighbour, points fastest; else 0
  std::size_t counts[points] = {};
  double own[9][points] = {}; // for means: first and second moments of the points' own means

  // Results for each point; 0 without a good gradient.
  double gradient[3][points];
  double correction[points]; // for means: added to the point's mean, the value at the point
  double unfit[points];      // fraction of the values' squares that the polynomial leaves
  double lowest[points], highest[points]; // of the values and 0
};

/// Fits the polynomials of all points, independently of each other.
using FitPoints = void (*)(PointFit& fit);

/// Returns variants for the instructions that this processor has, slowest first.
std::vector<FitPoints> functionsToFit();

} // namespace filters
