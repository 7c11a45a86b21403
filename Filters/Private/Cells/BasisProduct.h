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

/// Returns the number of different parametric coordinates along an axis, less one. `places`: three of
/// each point.
int orderAlong(const std::vector<double>& places, std::size_t axis);

/**
 * Interpolates in curved cells of any order by products of polynomials of Lagrange (equidistant
 * nodes) or of Bernstein (Bezier cells, also rational ones). Hexahedra are products of three lines,
 * wedges of a triangle and a line; tetrahedra are no products. VTK's functions for some of these
 * allocate objects at each call and take 1000 times as long.
 */
class BasisProduct
{
public:
  /// Sets a cell of type `type`. Returns whether VTK's functions give the same.
  bool set(vtkGenericCell* cell, int type);

  /// Interpolates `points` with their weights, and differentiates by each parametric coordinate.
  void evaluate(
    const double place[3], const std::vector<Vector>& points, Vector& sum, Vector derivatives[3]);
  void weights(const double place[3], double* weights);

private:
  /// A line, a triangle or a tetrahedron.
  struct Factor
  {
    int dimension = 0; // 0: no factor
    int order = 0;
    std::vector<std::array<int, 4>>
      nodes;                   // barycentric coordinates times the order; the first is implied
    std::vector<double> basis; // at each node
    std::array<std::vector<double>, 3> slopes; // by each coordinate
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
  std::vector<std::size_t> Points; // points in the order of nodes, the first factor's fastest
  std::vector<double> Rational;    // weights of the points; empty: equal
  std::vector<Vector> Weighted, WeightsAlone;
};

} // namespace filters
