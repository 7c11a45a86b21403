// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "AmrLevels.h"
#include "GasBoundary.h"
#include "Medium/MediumSource.h"
#include "WorkProgress.h"

#include <memory>
#include <vector>

class vtkDataObject;

namespace refractivity
{

/**
 * The refractivity of adaptive meshes whose cells hold the values, box by box, for the tracer.
 *
 * What is asked for is made of cells of one level at a time: the coarsest that is no coarser than the lattice. As in
 * RefractivityOfAmr, a cell under finer blocks has the mean of the finer cells, and one that no block of its level
 * holds has the mean over its place of a polynomial through the next coarser level; so the borders of blocks and levels
 * do not show. Points take the values of the same polynomials, not means: a medium has values at its points.
 */
class AmrSource : public schlieren::MediumSource
{
public:
  /// Whether all of the domain has values, so that gas ends nowhere but at bodies.
  static bool canShow(const AmrLevels& levels, const Source& source);

  /// `bodies`: may be null.
  AmrSource(const AmrLevels& levels, const Source& source, vtkDataObject* bodies, Tally& tally,
    const WorkProgress& progress = WorkProgress());

  bool hasGas() const { return this->HasGas; }
  /// Whether there are cells without a number, which are solid: this source does not know of them.
  bool hasSolids() const { return this->HasSolids; }
  /// Whether the bodies reach into the box of the gas.
  bool meetsBodies() const;

  schlieren::Box bounds() const override;
  double ambient() const override;
  std::array<double, 3> voxelShape() const override;
  Content contentOf(const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override;

private:
  /// Cells of a level that are known: those of a block, or the means of a finer block's.
  struct Block
  {
    CellBox box;
    std::vector<double> means;
    std::vector<float> parts; // of a cell that its mean is of; 0: not known
    bool isOfLevel;           // rather than finer

    /// N of parts of the block, for contentOf(); lowest > highest: none.
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
    std::array<double, 3> spacing;
    Counts cells;
    std::vector<Block> blocks;
    std::unique_ptr<BoxBins> bins;
  };
  static constexpr int pieceEdge = 8; // cells

  static Block coarser(const Block& block, const Counts& ratio);
  CellBox cellsIn(const Level& level, const schlieren::Box& box, int margin) const;
  std::vector<double> valuesIn(std::size_t level, const CellBox& box) const;
  std::size_t levelFor(const schlieren::Lattice& lattice) const;

  std::array<double, 3> Origin;
  std::vector<Level> Levels;
  GasBoundary Bodies; // no faces of its own
  bool HasGas = false, HasSolids = false;
};

} // namespace refractivity
