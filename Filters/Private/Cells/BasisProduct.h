// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Vectors.h"

#include <array>
#include <cstddef>
#include <vector>

class vtkCell;
class vtkGenericCell;

namespace filters
{

/**
 * What is interpolated in curved cells of any order: products of polynomials of Lagrange (nodes at equal distances) or of
 * Bernstein (Bezier cells, also rational ones). Hexahedra are products of three lines, wedges of a triangle and a line,
 * tetrahedra are no products. VTK's functions for some of these make objects whenever they are called, which takes 1000
 * times as long.
 */
class BasisProduct
{
public:
  /// Of a cell; whether this gives what VTK's functions do. `type`: of the cell.
  bool set(vtkGenericCell* cell, int type);

  /// The sum of `points` with their weights at parametric coordinates, and its derivative along each of them.
  void evaluate(
    const double place[3], const std::vector<Vector>& points, Vector& sum, Vector derivatives[3]);
  void weights(const double place[3], double* weights);

private:
  /// Of a line, a triangle or a tetrahedron.
  struct Factor
  {
    int dimension = 0; // 0: no factor
    int order = 0;
    std::vector<std::array<int, 4>>
      nodes; // barycentric coordinates, times the order; the first is what is left
    std::vector<double> basis;                 // of each node
    std::array<std::vector<double>, 3> slopes; // by each of its coordinates
  };

  static Factor factorOf(int dimension, int order);
  bool make(int type);
  bool isLike(vtkCell* cell, int type);
  void findBasis(Factor& factor, const double* place) const;
  void findBases(const double place[3]);
  void sumUp(const std::vector<Vector>& points, Vector& sum, Vector derivatives[3]) const;

  int Type = -1;
  bool IsUsable = false, IsBezier = false;
  std::vector<double> Places; // parametric coordinates of the cell's points
  std::array<Factor, 3> Factors;
  std::vector<std::size_t>
    Points; // their numbers in the cell: the first factor's nodes one after the other, ...
  std::vector<double> Rational; // weights of the points; empty: they are equal
  std::vector<Vector> Weighted, WeightsAlone;
};

} // namespace filters
