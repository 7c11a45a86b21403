// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellShape.h"

#include <vector>

namespace filters
{

/**
 * A cell whose coordinates are polynomials of its parametric ones (see CellShape.h), both relative
 * to its middle. In units of the cell's edges there (`normal`), coordinates are the parametric ones
 * plus the bends.
 */
struct NormalCell
{
  CellShape shape;
  bool isAffine;
  bool isSmooth;      // else slope and limit are unset
  double bend[3][4];  // coefficients of uv, vw, uw and uvw
  double value[8];    // a polynomial
  double slope[3][8]; // polynomials times the normal coordinates, added to the value
  double limit[2][8]; // polynomials that bound the sum
};

/// Points of one cell, as arrays of coordinates.
struct CellPoints
{
  static constexpr int most = 256;
  static constexpr int room = most + 8; // for whole packs
  double normal[3][room];               // input
  double value[room];                   // interpolated
  double miss[room]; // distance of a parametric coordinate from its range; infinite: far outside
};

/// Sets value and miss of `count` points, independently of each other.
using LocateInCell = void (*)(const NormalCell& cell, int count, CellPoints& points);

/// Returns variants for the instructions that this processor has, slowest first.
std::vector<LocateInCell> functionsToLocate();

} // namespace filters
