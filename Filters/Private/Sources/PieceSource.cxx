// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/PieceSource.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace filters
{

PieceSource::PieceSource(std::unique_ptr<const DataPiece> piece,
  std::shared_ptr<const GasBoundary> boundary, double ambient,
  std::shared_ptr<LatticesOfMesh> lattices, const std::optional<DataPiece::Facts>& facts)
  : Piece(std::move(piece))
  , All(facts ? *facts : this->Piece->facts())
  , Boundary(std::move(boundary))
  , Lattices(std::move(lattices))
  , Ambient(
      std::isnan(ambient) ? 0.5 * (this->All.content.lowest + this->All.content.highest) : ambient)
{
}

schlieren::MediumSource::Content PieceSource::contentOf(const schlieren::Box& box) const
{
  return this->contentFrom(
    box, [this](const Point& place) { return this->Piece->holds(place); },
    [&] { return this->Piece->contentOf(box); });
}

schlieren::MediumSource::Content PieceSource::contentFrom(const schlieren::Box& box,
  const CellTest& holds, const std::function<CellTree::Content()>& cells) const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Content content{ 1, 0, { infinity, infinity, infinity }, false, false, false };
  this->Boundary->findPlaces(box, holds, content);
  if (content.hasGas)
  {
    const CellTree::Content found = cells();
    content.lowest = found.lowest;
    content.highest = found.highest;
    content.cellSize = found.cellSize;
  }
  return content;
}

void PieceSource::sampleGas(const schlieren::Lattice& lattice, double* refractivity,
  unsigned char* found, double* values, CellsOfLattice* cells) const
{
  this->Piece->sample(lattice, refractivity, found, values, cells);
}

bool PieceSource::sampleGasIn(const CellsOfLattice& cells, const schlieren::Lattice& lattice,
  double* refractivity, double* values) const
{
  return this->Piece->sampleIn(cells, lattice, refractivity, values);
}

void PieceSource::sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances, double* values) const
{
  const auto size = static_cast<std::size_t>(lattice.size());
  const auto known = this->Lattices ? this->Lattices->find(lattice, distances) : nullptr;
  if (known && this->sampleGasIn(known->cells, lattice, refractivity, values))
  {
    known->copyTo(places, distances, size);
  }
  else
  {
    const bool isKept = this->Lattices && this->Lattices->hasRoomFor(lattice);
    CellsOfLattice cells;
    std::vector<unsigned char> found(size);
    this->sampleGas(lattice, refractivity, found.data(), values, isKept ? &cells : nullptr);
    this->Boundary->sample(lattice, found.data(), places, distances);
    if (isKept)
    {
      this->Lattices->keep(lattice, knownLattice(std::move(cells), places, distances, size));
    }
  }
  const std::size_t count = values ? size * static_cast<std::size_t>(this->fields()) : 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    values[i] = places[i % size] == schlieren::Place::Gas
      ? values[i]
      : std::numeric_limits<double>::quiet_NaN();
  }
}

} // namespace filters
