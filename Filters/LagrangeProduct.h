// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Vectors.h"

#include <array>
#include <cstddef>
#include <vector>

class vtkGenericCell;

namespace filters
{

/// What is interpolated in Lagrange hexahedra and quadrilaterals: products of polynomials of Lagrange along each axis,
/// with nodes at equal distances. With VTK's conventions, and some ten times as fast as its functions.
class LagrangeProduct
{
public:
  /// Of a cell; whether it is one of these types, and has as many points as its order says.
  bool set(vtkGenericCell* cell);

  /// The sum of `points` with their weights at parametric coordinates, and its derivative along each of them.
  void evaluate(
    const double place[3], const std::vector<Vector>& points, Vector& sum, Vector derivatives[3]);
  void weights(const double place[3], double* weights);

private:
  void findBasis(const double place[3]);

  std::array<std::size_t, 3> Nodes{}; // along each axis
  std::vector<std::size_t> Points;    // their numbers in the cell, row by row
  std::array<std::vector<double>, 3> Basis, Slopes;
};

} // namespace filters
