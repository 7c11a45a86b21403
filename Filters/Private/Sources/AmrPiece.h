// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrField.h"
#include "Sources/DataPiece.h"

namespace filters
{

/// Adaptive meshes with values in cells; see AmrField.
class AmrPiece : public DataPiece
{
public:
  /// `levels`: turned if flat (see turnedAcrossZ()).
  AmrPiece(const AmrLevels& levels, const Flow& flow, Tally& tally,
    const WorkProgress& progress = WorkProgress());

  const AmrField& refractivity() const { return this->Field; }

  Facts facts() const override;
  CellTree::Content contentOf(const schlieren::Box& box) const override
  {
    return this->Field.contentOf(box);
  }
  bool holds(const Point& place) const override { return this->Field.hasGasAt(place); }
  void sample(const schlieren::Lattice& lattice, double* refractivity, unsigned char* found,
    CellsOfLattice* cells) const override;

private:
  const AmrField Field;
};

} // namespace filters
