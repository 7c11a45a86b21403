// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Vectors.h"

#include <array>
#include <vector>

namespace filters
{

/**
 * A point with its neighbours, and the quadratic polynomial that fits best what their values are, by least squares: see
 * PointNeighbours.
 *
 * Values are those at the points, or means over some volume around each of them, whose moments are known (see
 * CellsAround): then the polynomial's means over these volumes are what fits the values.
 */
struct PointFit
{
  enum class Values
  {
    AtPoints,
    Means
  };
  struct Neighbour
  {
    Vector
      x; ///< counted from the point; of means: the first moments, less those of the point's own
    double value;                   ///< less the point's own
    std::array<double, 6> second{}; ///< of means: xx, yy, zz, xy, yz, zx, likewise
  };

  Values values = Values::AtPoints;
  std::vector<Neighbour> neighbours;
  std::array<double, 9> own{}; ///< of means: first and second moments of the point's own one

  /// Finds what follows from the above.
  void find();

  Vector gradient{};              ///< 0: there is no good one
  double correction = 0;          ///< of means: what makes its own one the value at the point
  double unfit = 0;               ///< the part of the values' squares that the polynomial leaves
  double lowest = 0, highest = 0; ///< of the values and 0
};

} // namespace filters
