// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrField.h"
#include "Sources/DataPiece.h"

#include <memory>
#include <vector>

namespace filters
{

/// Adaptive meshes with values in cells; see AmrField.
class AmrPiece : public DataPiece
{
public:
  /// `levels`: turned if flat (see turnedAcrossZ()). `fields`: of the same blocks, with values in
  /// cells, NaN where there is none.
  AmrPiece(const AmrLevels& levels, const Flow& flow, const std::vector<Flow>& fields, Tally& tally,
    const WorkProgress& progress = WorkProgress());

  const AmrField& refractivity() const { return *this->Fields[0]; }

  Facts facts() const override;
  CellTree::Content contentOf(const schlieren::Box& box) const override
  {
    return this->Fields[0]->contentOf(box);
  }
  bool holds(const Point& place) const override { return this->Fields[0]->hasGasAt(place); }
  int fields() const override { return static_cast<int>(this->Fields.size()) - 1; }
  schlieren::MediumSource::FieldRange rangeOfField(
    int field, const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, unsigned char* found,
    double* fields, CellsOfLattice* cells) const override;

private:
  std::vector<std::unique_ptr<const AmrField>> Fields; // N first
};

} // namespace filters
