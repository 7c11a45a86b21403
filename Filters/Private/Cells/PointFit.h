// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace filters
{

/**
 * Several points, each with its neighbours, and the quadratic polynomials that fit best what their values are, by least
 * squares: see PointTrends.h.
 *
 * Values are those at the points, or means over some volume around each of them, whose moments are known (see
 * CellsAround): then the polynomials' means over these volumes are what fits the values.
 *
 * Eigen's solvers, one point at a time, make the first image of 1.08 million tetrahedra take 1.2 times as long, and that of
 * the next time step 1.4 times.
 */
struct PointFit
{
  static constexpr int points = 8; // at once
  enum class Values
  {
    AtPoints,
    Means
  };

  /// Squares of the distance to the middle of what is around a point, in units of how far that reaches along the same
  /// direction: up to where it is on all sides, and from where it is on one side alone.
  static constexpr double onAllSides = 0.15, onOneSide = 0.45;

  /// Sets how many neighbours the points have at most, and that they have none as yet.
  void clear(std::size_t most, Values values = Values::AtPoints);

  /// Adds one, counted from the point.
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
  std::size_t neighbours = 0;   // of the point with most of them
  std::size_t perNeighbour = 4; // numbers
  std::vector<double>
    numbers; // x, y, z, value (and second moments) of each neighbour, of all points at a time; else 0
  std::size_t counts[points] = {};
  double own[9][points] = {}; // of means: first and second moments of the points' own ones

  // What is found of each point: 0 where there is no good gradient.
  double gradient[3][points];
  double correction[points]; // of means: what makes its own one the value at the point
  double unfit[points];      // the part of the values' squares that the polynomial leaves
  double lowest[points], highest[points]; // of the values and 0
  // Of values at points: what the gradient alone makes of half the way to the neighbours at least and at most, and the
  // mean over the neighbours of what second derivatives make, but those across the boundary, where
  // three points in a row do not distinguish an extremum from the edge of a shock.
  double leastHalf[points], mostHalf[points], bend[points];
};

/// Fits the polynomials of all points, each by itself, whatever the others are.
using FitPoints = void (*)(PointFit& fit);

/// For the instructions that this processor has, slower ones first.
std::vector<FitPoints> functionsToFit();

} // namespace filters
