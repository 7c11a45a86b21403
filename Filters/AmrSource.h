// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "AmrFaces.h"
#include "AmrLevels.h"
#include "FlatData.h"
#include "GasBoundary.h"
#include "Medium/MediumSource.h"
#include "WorkProgress.h"

#include <memory>
#include <vector>

class vtkDataObject;

namespace filters
{

/**
 * The refractivity of adaptive meshes whose cells hold the values, box by box, for the tracer.
 *
 * What is requested is made of cells of one level at a time: the coarsest that is no coarser than the lattice. As in
 * RefractivityOfAmr, a cell under finer blocks has the mean of the finer cells, and one that no block of its level
 * holds has the mean over its place of a polynomial through the next coarser level; so the borders of blocks and levels
 * do not show. Points take the values of the same polynomials, not means: a medium has values at its points.
 *
 * Cells that are hidden or whose N is not finite are walls, as they stand: with the edges of cells.
 */
class AmrSource : public schlieren::MediumSource
{
public:
  /// `levels`: turned, where they are flat (see turnedAcrossZ). `bodies`: may be null.
  AmrSource(const AmrLevels& levels, const Source& source, vtkDataObject* bodies, Outside outside,
    Tally& tally, const WorkProgress& progress = WorkProgress());

  /// One more field of the same blocks: `source` has its values in their cells, NaN where there is none.
  void addField(const AmrLevels& levels, const Source& source);

  bool hasGas() const { return this->HasGas; }
  /// Whether the bodies reach into the box of the gas.
  bool meetsBodies() const;

  schlieren::Box bounds() const override;
  double ambient() const override;
  std::array<double, 3> voxelShape() const override;
  bool isFlat() const override { return this->FlatAxis >= 0; }
  std::array<double, 9> direction() const override { return directionAcross(this->FlatAxis); }
  Content contentOf(const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override;

  int fields() const override { return static_cast<int>(this->Fields.size()); }
  FieldRange rangeOfField(int field, const schlieren::Box& box) const override;
  void sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
    schlieren::Place* places, float* distances, double* values) const override;

private:
  /// Cells of a level that are known: those of a block, or the means of a finer block's.
  struct Block
  {
    CellBox box;
    std::vector<double> means;
    std::vector<float> parts; // of a cell that its mean is of; 0: not known
    std::vector<bool> solids; // which of the cells that are not known; empty: none
    bool isOfLevel;           // rather than finer

    bool isSolid(std::size_t cell) const { return !this->solids.empty() && this->solids[cell]; }

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
  std::size_t axes() const { return this->isFlat() ? 2 : 3; } // along which there are several cells
  CellBox cellsIn(const Level& level, const schlieren::Box& box, int margin) const;
  std::vector<double> valuesIn(std::size_t level, const CellBox& box) const;
  std::size_t levelFor(const schlieren::Lattice& lattice) const;
  CellState stateOf(std::size_t level, const Counts& cell) const;
  bool hasGasAt(const Point& place) const;
  BoundaryFaces findFaces();

  int FlatAxis;
  std::array<double, 3> Origin;
  std::vector<Level> Levels;
  std::unique_ptr<const GasBoundary> Boundary;
  bool HasGas = false;
  bool IsBox = true; // whether the domain is one, with blocks all over
  std::vector<std::unique_ptr<const AmrSource>> Fields; // each as if it were a refractivity
};

} // namespace filters
