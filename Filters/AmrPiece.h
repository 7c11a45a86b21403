// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "AmrField.h"
#include "DataPiece.h"

#include <utility>
#include <vector>

namespace filters
{

/// The blocks that one rank has of adaptive meshes whose cells hold the values.
class AmrPiece : public DataPiece
{
public:
  /// N, and further fields of the same blocks; with the copies of others' cells.
  explicit AmrPiece(std::vector<AmrField> fields)
    : Fields(std::move(fields))
  {
  }

  Summary summary() const override;
  /// The triangles of AmrField::faces(), which of them hide something, and AmrField::outerValues().
  void putBoundary(std::int64_t cellsOfAll, std::vector<char>& message) const override;
  CellTree::Content contentOf(const schlieren::Box& box) const override
  {
    return this->Fields[0].contentOf(box);
  }
  bool holds(const Point& place) const override { return this->Fields[0].hasGasAt(place); }
  int fields() const override { return static_cast<int>(this->Fields.size()) - 1; }
  schlieren::MediumSource::FieldRange rangeOfField(
    int field, const schlieren::Box& box) const override;
  Samples sample(const schlieren::Lattice& lattice) const override;

private:
  std::vector<AmrField> Fields;
};

} // namespace filters
