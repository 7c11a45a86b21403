// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/AmrPiece.h"

#include "Input/FlatData.h"

#include <algorithm>
#include <limits>

namespace filters
{

AmrPiece::AmrPiece(const AmrLevels& levels, const Flow& flow, const std::vector<Flow>& fields,
  Tally& tally, const WorkProgress& progress)
{
  this->Fields.push_back(std::make_unique<const AmrField>(levels, flow, tally, progress));
  Tally notReported;
  for (const Flow& field : fields)
  {
    this->Fields.push_back(std::make_unique<const AmrField>(levels, field, notReported));
  }
}

DataPiece::Facts AmrPiece::facts() const
{
  const AmrField& field = this->refractivity();
  return { field.ownCells(), field.bounds(), field.contentOf(field.bounds()), field.voxelShape(),
    directionAcross(field.flatAxis()), field.flatAxis() >= 0 };
}

schlieren::MediumSource::FieldRange AmrPiece::rangeOfField(
  int field, const schlieren::Box& box) const
{
  const CellTree::Content content =
    this->Fields[static_cast<std::size_t>(field) + 1]->contentOf(box);
  return { content.lowest, content.highest };
}

void AmrPiece::sample(const schlieren::Lattice& lattice, double* refractivity, unsigned char* found,
  double* fields, CellsOfLattice*) const
{
  this->Fields[0]->sample(lattice, refractivity);
  const std::vector<unsigned char> hasGas = this->Fields[0]->gasAt(lattice);
  std::copy(hasGas.begin(), hasGas.end(), found);
  for (std::size_t field = 1; fields && field < this->Fields.size(); ++field)
  {
    this->Fields[field]->sample(lattice, fields);
    for (const unsigned char isKnown : this->Fields[field]->gasAt(lattice))
    {
      *fields = isKnown ? *fields : std::numeric_limits<double>::quiet_NaN();
      ++fields;
    }
  }
}

} // namespace filters
