// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellSampler.h"
#include "Cells/CellTree.h"
#include "Common/Vectors.h"
#include "Common/WorkProgress.h"

#include "Schlieren.h"

#include <array>
#include <cstdint>
#include <vector>

namespace filters
{

/// All data of a process, or a rank's piece of them and the points that it answers for.
/// Thread-safe.
class DataPiece
{
public:
  DataPiece() = default;
  DataPiece(const DataPiece&) = delete;
  DataPiece& operator=(const DataPiece&) = delete;
  virtual ~DataPiece() = default;

  /// Describes the whole piece.
  struct Facts
  {
    std::int64_t cells; ///< or points; 0: no gas
    schlieren::Box bounds;
    CellTree::Content content;
    std::array<double, 3> voxelShape; ///< see MediumSource, as the others
    std::array<double, 9> direction;
    bool isFlat;
  };
  virtual Facts facts() const = 0;
  virtual bool dependsOnLattice() const { return true; } ///< see MediumSource

  /// Returns the content of a box; see CellTree::content().
  virtual CellTree::Content contentOf(const schlieren::Box& box) const = 0;

  /// Returns whether the piece has gas of its own at a point.
  virtual bool holds(const Point& place) const = 0;
  /// Tests several points, in parallel; those that are not finite have none.
  std::vector<unsigned char> hold(
    const std::vector<Point>& places, const WorkProgress& progress = WorkProgress()) const;

  /// Sets `found`, 1 or 0, at all points of a lattice that the piece holds(), and there N. Of meshes, fills `cells`, if not null.
  virtual void sample(const schlieren::Lattice& lattice, double* refractivity, unsigned char* found,
    CellsOfLattice* cells = nullptr) const = 0;
  /// Samples in cells of an earlier call on the same mesh. Returns false if that is not possible.
  virtual bool sampleIn(const CellsOfLattice& /*cells*/, const schlieren::Lattice& /*lattice*/,
    double* /*refractivity*/) const
  {
    return false;
  }

  /// Returns a number that is equal for two pieces only if their meshes are equal; 0: unknown.
  virtual std::uint64_t meshKey() const { return 0; }
};

} // namespace filters
