// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/LatticeCache.h"
#include "Sources/DataPiece.h"
#include "Walls/GasBoundary.h"

#include "Schlieren.h"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

namespace filters
{

/// The refractivity of a piece of data and its boundary, for bricks of the tracer.
class PieceSource : public schlieren::MediumSource
{
public:
  /// `ambient`: NaN for the middle of the range. `lattices`: of earlier time steps; may be null.
  /// `facts`: of all data; by default the piece's.
  PieceSource(std::unique_ptr<const DataPiece> piece, std::shared_ptr<const GasBoundary> boundary,
    double ambient, std::shared_ptr<LatticeCache> lattices = nullptr,
    const std::optional<DataPiece::Facts>& facts = {});

  bool hasGas() const { return this->All.cells > 0; }
  const GasBoundary& boundary() const { return *this->Boundary; }
  bool meetsBodies() const { return this->Boundary->hasBodiesIn(this->bounds()); }

  schlieren::Box bounds() const override { return this->All.bounds; }
  double ambient() const override { return this->Ambient; }
  std::array<double, 3> voxelShape() const override { return this->All.voxelShape; }
  bool isFlat() const override { return this->All.isFlat; }
  std::array<double, 9> direction() const override { return this->All.direction; }
  Content contentOf(const schlieren::Box& box) const override;
  bool dependsOnLattice() const override { return this->Piece->dependsOnLattice(); }
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override;

protected:
  const DataPiece& piece() const { return *this->Piece; }
  const DataPiece::Facts& facts() const { return this->All; }

  /// Combines kinds of points, by the boundary, with the cells that have gas. `holds`: whether the
  /// piece holds a point of GasBoundary::testedPlaces(), by its number and place. Both are used where the boundary leaves it
  /// open.
  Content contentFrom(const schlieren::Box& box,
    const std::function<bool(std::size_t, const Point&)>& holds,
    const std::function<CellTree::Content()>& cells) const;

  /// Call DataPiece::sample() and DataPiece::sampleIn().
  virtual void sampleGas(const schlieren::Lattice& lattice, double* refractivity,
    unsigned char* found, CellsOfLattice* cells) const;
  virtual bool sampleGasIn(
    const CellsOfLattice& cells, const schlieren::Lattice& lattice, double* refractivity) const;

private:
  const std::unique_ptr<const DataPiece> Piece;
  const DataPiece::Facts All;
  const std::shared_ptr<const GasBoundary> Boundary;
  const std::shared_ptr<LatticeCache> Lattices;
  const double Ambient;
};

} // namespace filters
