// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellShape.h"

#include <array>
#include <utility>
#include <vector>

class vtkCell;

namespace filters
{

/// A point as a weighted mean of a cell's points: one of them, or more.
using Node = std::vector<std::pair<int, double>>;

/// How a curved cell is divided into linear ones, as others of its type with its orders.
struct CellDivision
{
  struct Part
  {
    CellShape shape;
    std::vector<int> nodes; // corners
  };
  std::vector<Node> nodes;
  std::vector<Part> parts;

  /// Divides a cell with a known skeleton at its nodes: those of a lattice; of pyramids, the middles
  /// of edges and of the base.
  static CellDivision atNodes(vtkCell* cell, CellShape skeleton);
  /// Makes one linear cell with the same corners.
  static CellDivision cornersOnly(CellShape skeleton);

private:
  void addPoints(int count);
  int addNode(vtkCell* cell, const std::array<double, 3>& place);
  void dividePyramid(vtkCell* cell);
  void divideLattice(vtkCell* cell, CellShape skeleton);
};

/// Returns the shape of a curved cell's corners, which are its first points; Other: not curved.
CellShape skeletonOf(int type);

} // namespace filters
