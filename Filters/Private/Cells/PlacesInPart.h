// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/PlacesInCell.h"

#include <vector>

namespace filters
{

/// Ranges of parametric coordinates.
enum class Reference : unsigned char
{
  Box,
  Wedge,  // the first two are those of a triangle
  Simplex // a tetrahedron
};

/**
 * A part of a curved cell, a box of its parametric coordinates. Normal coordinates and the value are
 * polynomials of coordinates that are -1 to 1 in the part.
 */
struct CurvedPart
{
  Reference reference;
  int orders[3]; // of the polynomials; of tetrahedra and triangles, in all coordinates together
  // Of x, y, z and the value, four for each term; that of the i-th, j-th and k-th power is term
  // (i * (orders[1] + 1) + j) * (orders[2] + 1) + k.
  const double* coefficients;
  double middle[3], half[3]; // in parametric coordinates of the cell
  bool isRegular;            // normal coordinates are nearly those of the part
  double tolerance;          // of the cell's parametric coordinates

  int lastAlong1(int i) const
  {
    return this->reference == Reference::Box ? this->orders[1] : this->orders[1] - i;
  }
  int lastAlong2(int i, int j) const
  {
    return this->reference == Reference::Simplex ? this->orders[2] - i - j : this->orders[2];
  }
};

/// Sets value and miss of `count` points in a cell of which a part may hold them.
using LocateInPart = void (*)(const CurvedPart& part, int count, CellPoints& points);

/// Returns variants for the instructions that this processor has, slowest first.
std::vector<LocateInPart> functionsToLocateInPart();

} // namespace filters
