// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrFaces.h"
#include "Amr/AmrLevels.h"
#include "Cells/CellTree.h"
#include "Common/Vectors.h"
#include "Common/WeightedMedian.h"
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
 * N, or another field, in the cells of adaptive meshes, and what is between the cells.
 *
 * Values of a lattice are made of cells of one level: the coarsest that is no coarser than the lattice. A cell under finer
 * blocks has the mean of the finer cells, and one that no block of its level holds has the mean over its place of a
 * polynomial through the next coarser level (fourth degree, one axis after the other); so the borders of blocks and levels
 * do not show. Points take the values of the same polynomials, not means: a medium has values at its points.
 *
 * Cells that are hidden or whose value is not finite are solid.
 */
class AmrField
{
public:
  /// `levels`: of all blocks; turned, where they are flat (see turnedAcrossZ). `source` has their
  /// images. To `tally` is added what is wrong with their values.
  AmrField(const AmrLevels& levels, const Source& source, Tally& tally,
    const WorkProgress& progress = WorkProgress());

  int flatAxis() const { return this->FlatAxis; }
  std::int64_t ownCells() const { return this->OwnCells; } // with values
  schlieren::Box bounds() const { return this->Bounds; }   // of the domain
  std::array<double, 3> voxelShape() const { return this->Levels[0].spacing; }

  /// The faces around cells without gas, and those of gas beside what no block holds.
  BoundaryFaces faces() const;

  /// Values of cells at the border of the domain, each with an area; of more than a million each nth.
  std::vector<WeightedValue> outerValues() const;

  /// Of cells within a few cells of a box; see CellTree::content(). lowest > highest: there are none.
  CellTree::Content contentOf(const schlieren::Box& box) const;
  /// Whether one of the cells holds the place. Outside of a domain that is a box, as at its border.
  bool hasGasAt(const Point& place) const;
  /// The same of all points of a lattice.
  std::vector<unsigned char> gasAt(const schlieren::Lattice& lattice) const;
  /// At those points of a lattice whose indices are in `points`; NaN in solids.
  void sample(const schlieren::Lattice& lattice, const CellBox& points, double* values) const;

private:
  /// What a value depends on is no more cells of the lattice's level away: two coefficients of the spline, of which each
  /// depends on two cells more. Of the next coarser level it is half as far, and what a polynomial reads.
  static constexpr int cellsOfSpline = 4;

  /// Cells of a level that are known: those of a block, or the means of a finer block's.
  struct Block
  {
    CellBox box;
    std::vector<double> means;
    std::vector<float> parts; // of a cell that its mean is of; 0: not known
    std::vector<bool> solids; // which of the cells that are not known; empty: none
    bool isOfLevel;           // rather than finer

    bool isEmpty() const; // nothing is known of any cell
    bool isSolid(std::size_t cell) const { return !this->solids.empty() && this->solids[cell]; }

    /// Values of parts of the block, for contentOf(); lowest > highest: none.
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
    std::unique_ptr<const BoxBins> covered; // by finer blocks
    std::vector<Block> blocks;
    std::unique_ptr<const BoxBins> bins;
  };
  /// Cells of a block that are looked at together, along each axis.
  static constexpr int pieceEdge = 8;
  static Block coarser(const Block& block, const Counts& ratio);
  void addOwn(std::size_t level, Block block);
  void sortBlocks();
  void findMissingCells();
  int outerCellsForOne() const;
  /// Along which there are several cells.
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
  // Cells of the coarsest level that no block has; empty: the domain is a box, with blocks all over.
  std::vector<bool> AreMissing;
};

} // namespace filters
