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

/// The cells that contain points of a lattice, and these points: four bytes for each cell, and two
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
 * Interpolates in the cells of meshes to the points of lattices.
 *
 * Cells search for the points that they contain, with a tolerance. Of several cells the one out of
 * which a point is least, and of these the first, decides. So values do not depend on the lattice, apart
 * from rounding. Thread-safe.
 */
class CellSampler
{
public:
  /// Keeps a reference to the tree.
  explicit CellSampler(const CellTree& tree);

  /// Sets `values` and `found`, 1 or 0, at all points of a lattice; values are 0 outside of cells.
  /// Fills `cells`, if not null; the lattice then has at most CellsOfLattice::maxPoints.
  void sample(const schlieren::Lattice& lattice, double* values, unsigned char* found,
    CellsOfLattice* cells = nullptr) const;

  /// Interpolates in known cells of the same mesh: exactly the same values. Returns whether all
  /// points were found again.
  bool sample(const schlieren::Lattice& lattice, const CellsOfLattice& cells, double* values) const;

private:
  const CellTree& Tree;
};

} // namespace filters
