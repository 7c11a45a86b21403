// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/AmrPiece.h"

#include "Input/FlatData.h"

#include <algorithm>

namespace filters
{

AmrPiece::AmrPiece(
  const AmrLevels& levels, const Flow& flow, Tally& tally, const WorkProgress& progress)
  : Field(levels, flow, tally, progress)
{
}

DataPiece::Facts AmrPiece::facts() const
{
  const AmrField& field = this->refractivity();
  return { field.ownCells(), field.bounds(), field.contentOf(field.bounds()), field.voxelShape(),
    directionAcross(field.flatAxis()), field.flatAxis() >= 0 };
}

void AmrPiece::sample(const schlieren::Lattice& lattice, double* refractivity, unsigned char* found,
  CellsOfLattice*) const
{
  this->Field.sample(lattice, refractivity);
  const std::vector<unsigned char> hasGas = this->Field.gasAt(lattice);
  std::copy(hasGas.begin(), hasGas.end(), found);
}

} // namespace filters
