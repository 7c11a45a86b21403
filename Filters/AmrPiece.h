// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "AmrField.h"
#include "DataPiece.h"

#include <vector>

namespace filters
{

/// The blocks that one rank has of adaptive meshes whose cells hold the values.
class AmrPiece : public DataPiece
{
public:
  /// `field`: with the copies of others' cells.
  explicit AmrPiece(AmrField field)
    : Field(std::move(field))
  {
  }

  Summary summary() const override;
  /// The triangles of AmrField::faces(), which of them hide something, and AmrField::outerValues().
  void putBoundary(std::vector<char>& message) const override;
  CellTree::Content contentOf(const schlieren::Box& box) const override
  {
    return this->Field.contentOf(box);
  }
  bool holds(const Point& place) const override { return this->Field.hasGasAt(place); }
  Samples sample(const schlieren::Lattice& lattice) const override;

private:
  AmrField Field;
};

} // namespace filters
