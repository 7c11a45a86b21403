// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrFaces.h"
#include "Amr/AmrLevels.h"
#include "Cells/CellTree.h"
#include "Common/Vectors.h"
#include "Common/WorkProgress.h"

#include "Schlieren.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace filters
{

/**
 * Reconstructs N, or another field, from cell means of adaptive meshes.
 *
 * Samples a lattice from cells of one level: the coarsest one whose cells are no larger than the
 * lattice's spacing. There, cells under finer blocks have the mean of the finer cells; cells that
 * no block of the level has get their means from a polynomial of fourth degree through the next
 * coarser level, axis by axis, which hides the borders of blocks and levels. Points get values, not
 * means. Hidden cells and cells whose value is not finite are solid.
 */
class AmrField
{
public:
  /// `levels`: those of all ranks' blocks, turned if flat (see turnedAcrossZ()). `flow` has the
  /// blocks of this rank. Counts doubtful values in `tally`.
  AmrField(const AmrLevels& levels, const Flow& flow, Tally& tally,
    const WorkProgress& progress = WorkProgress());

  int flatAxis() const { return this->FlatAxis; }
  std::int64_t ownCells() const { return this->OwnCells; } // cells with values
  schlieren::Box bounds() const { return this->Bounds; }   // bounds of the domain
  std::array<double, 3> voxelShape() const { return this->Levels[0].spacing; }

  /// Returns the faces around cells without gas, and those of gas beside cells that no block has.
  BoundaryFaces faces() const;

  /// Returns the values at the domain's border, weighted by area; of more than a million, each nth.
  std::vector<schlieren::WeightedValue> outerValues() const;

  /// Returns the content of the cells near a box; see CellTree::content(). lowest > highest: none.
  CellTree::Content contentOf(const schlieren::Box& box) const;
  /// Returns whether a cell contains the point, which a box-shaped domain clamps to it.
  bool hasGasAt(const Point& place) const;
  /// Returns hasGasAt() for all points of a lattice.
  std::vector<unsigned char> gasAt(const schlieren::Lattice& lattice) const;
  /// Samples the points of a lattice; NaN in solids.
  void sample(const schlieren::Lattice& lattice, double* values) const;

private:
  /// Known cells of a level: those of a block, or means of a finer block's cells.
  struct Block
  {
    CellBox box;
    std::vector<double> means;
    std::vector<float> parts; // known fraction of each cell; 0: unknown
    std::vector<bool> solids; // whether unknown cells are solid; empty: none is
    bool isOfLevel;           // instead of a finer level

    bool isEmpty() const; // no cell is known
    bool isSolid(std::size_t cell) const { return !this->solids.empty() && this->solids[cell]; }

    /// Range of values in a piece of the block, for contentOf(); lowest > highest: no values.
    struct Range
    {
      double lowest, highest;
    };
    Counts pieces;
    std::vector<Range> ranges;
    void findRanges();
  };
  struct Level
  {
    std::size_t number;
    std::array<double, 3> spacing;
    Counts cells;
    std::vector<AmrBlock> all; // blocks of the level
    std::unique_ptr<const BoxBins> binsOfAll;
    std::unique_ptr<const BoxBins> covered; // cells that finer blocks cover
    std::vector<Block> blocks;
    std::unique_ptr<const BoxBins> bins;
  };
  /// Edge length, in cells, of the pieces whose ranges are stored.
  static constexpr int pieceEdge = 8;
  static Block coarser(const Block& block, const Counts& ratio);
  void addOwn(std::size_t level, Block block);
  void sortBlocks();
  void findMissingCells();
  int outerCellsForOne() const;
  /// Returns the number of axes with several cells.
  std::size_t axes() const { return this->FlatAxis >= 0 ? 2 : 3; }
  CellBox cellsIn(const Level& level, const schlieren::Box& box, int margin) const;
  std::vector<double> valuesIn(std::size_t level, const CellBox& box) const;
  std::size_t levelFor(const schlieren::Lattice& lattice) const;
  CellState stateOf(std::size_t level, const Counts& cell) const;

  int FlatAxis;
  std::array<double, 3> Origin;
  schlieren::Box Bounds;
  std::vector<Level> Levels;
  std::int64_t OwnCells = 0;
  // Cells of the coarsest level that no block has; empty: the blocks fill the domain.
  std::vector<bool> AreMissing;
};

} // namespace filters
