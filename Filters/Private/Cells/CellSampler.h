// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellTree.h"

#include "Schlieren.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filters
{

/// What the search for a lattice's points has found: the cells that hold some, and which. Four bytes a cell, and two
/// more for each of them and for each point.
struct CellsOfLattice
{
  static constexpr std::int64_t maxPoints = 0xffff;

  std::vector<std::uint32_t> cells;  // places in the tree
  std::vector<std::uint16_t> starts; // of each cell's points, and the end
  std::vector<std::uint16_t> points;

  std::size_t bytes() const
  {
    return this->cells.size() * sizeof(std::uint32_t) +
      (this->starts.size() + this->points.size()) * sizeof(std::uint16_t);
  }
};

/**
 * What meshes hold at their points, interpolated in their cells to the points of lattices.
 *
 * Cells look for the points that they hold. Of several cells that hold a point the one that holds it best
 * counts (see MeshCell::find), of these the first. So what a point gets does not depend on the lattice,
 * rounding apart. May be used from many threads at once.
 */
class CellSampler
{
public:
  /// Keeps a reference to the tree.
  explicit CellSampler(const CellTree& tree);

  /// Sets `values` and `found`, 1 or 0, at all points of a lattice; values are 0 where no cell is. Fills `cells` where
  /// that is not null; the lattice then has no more than CellsOfLattice::maxPoints.
  void sample(const schlieren::Lattice& lattice, double* values, unsigned char* found,
    CellsOfLattice* cells = nullptr) const;

  /// The same values from what was found on the same mesh: to the last bit but in curved cells, where an iteration may
  /// begin elsewhere. Whether all points have been found again.
  bool sample(const schlieren::Lattice& lattice, const CellsOfLattice& cells, double* values) const;

private:
  const CellTree& Tree;
};

} // namespace filters
