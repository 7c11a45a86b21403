// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellShape.h"

#include <vector>

namespace filters
{

/**
 * A cell whose coordinates are a polynomial of its parametric ones (see CellShape.h). All of them are counted
 * from its middle, and coordinates in its edges there (`normal` ones): what makes them polynomials is what is
 * left apart from the parametric ones themselves.
 */
struct NormalCell
{
  CellShape shape;
  bool isAffine;
  bool isSmooth;      // else there are no slopes and limits
  double bend[3][4];  // factors of uv, vw, uw and uvw
  double value[8];    // a polynomial
  double slope[3][8]; // polynomials, to be added to the value, times the normal coordinates
  double limit[2][8]; // polynomials, which the sum lies between
};

/// Points of one cell, each number for all of them.
struct CellPoints
{
  static constexpr int most = 256;
  static constexpr int room = most + 8; // for packs
  double normal[3][room];               // coordinates
  double value[room];                   // what is interpolated
  double
    miss[room]; // by how much a parametric coordinate is out of its range; infinite: nowhere near
};

/// Sets value and miss of `count` points: each by itself, whatever the others are.
using LocateInCell = void (*)(const NormalCell& cell, int count, CellPoints& points);

/// For the instructions that this processor has, slower ones first.
std::vector<LocateInCell> functionsToLocate();

} // namespace filters
