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
  std::shared_ptr<LatticeCache> lattices, const std::optional<DataPiece::Facts>& facts)
  : Piece(std::move(piece))
  , All(facts ? *facts : this->Piece->facts())
  , Boundary(std::move(boundary))
  , Lattices(std::move(lattices))
  , Ambient(
      std::isnan(ambient) ? 0.5 * (this->All.content.lowest + this->All.content.highest) : ambient)
{
}

std::vector<unsigned char> DataPiece::hold(
  const std::vector<Point>& places, const WorkProgress& progress) const
{
  std::vector<unsigned char> are(places.size(), 0);
  forChunks(static_cast<vtkIdType>(places.size()), progress,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n)
      {
        const double sum = places[n][0] + places[n][1] + places[n][2];
        are[n] = std::isfinite(sum) && this->holds(places[n]) ? 1 : 0;
      }
    });
  return are;
}

schlieren::MediumSource::Content PieceSource::contentOf(const schlieren::Box& box) const
{
  return this->contentFrom(
    box, [&](std::size_t, const Point& place) { return this->Piece->holds(place); },
    [&] { return this->Piece->contentOf(box); });
}

schlieren::MediumSource::Content PieceSource::contentFrom(const schlieren::Box& box,
  const std::function<bool(std::size_t, const Point&)>& holds,
  const std::function<CellTree::Content()>& cells) const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto [hasWall, hasWindow] = this->Boundary->facesIn(box);
  Content content{ 1, 0, { infinity, infinity, infinity }, hasWall, hasWall || hasWindow,
    hasWindow };
  if (content.hasGas)
  {
    content.areWallsFlat = hasWall && !hasWindow && this->Boundary->areWallsFlatNear(box);
  }
  else
  {
    // A box without a boundary is all gas or not, though cells hold places a little beside them;
    // outside may be mixed.
    const std::array<Point, 9> tested = GasBoundary::testedPlaces(box, this->bounds());
    std::array<int, 3> counts{};
    for (std::size_t n = 0; n < tested.size(); ++n)
    {
      const schlieren::Place found = this->Boundary->kindAt(tested[n], holds(n, tested[n]));
      ++counts[static_cast<std::size_t>(found)];
    }
    const auto count = [&](schlieren::Place place)
    { return counts[static_cast<std::size_t>(place)]; };
    content.hasGas = 2 * count(schlieren::Place::Gas) > static_cast<int>(tested.size());
    content.hasWall = count(schlieren::Place::Wall) > 0;
    content.hasWindow = count(schlieren::Place::Window) > 0;
  }
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
  unsigned char* found, CellsOfLattice* cells) const
{
  this->Piece->sample(lattice, refractivity, found, cells);
}

bool PieceSource::sampleGasIn(
  const CellsOfLattice& cells, const schlieren::Lattice& lattice, double* refractivity) const
{
  return this->Piece->sampleIn(cells, lattice, refractivity);
}

void PieceSource::sample(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances) const
{
  const auto size = static_cast<std::size_t>(lattice.size());
  const auto known = this->Lattices ? this->Lattices->find(lattice, distances) : nullptr;
  if (known && this->sampleGasIn(known->cells, lattice, refractivity))
  {
    known->copyTo(places, distances, size);
  }
  else
  {
    const bool isKept = this->Lattices && this->Lattices->hasRoomFor(lattice);
    CellsOfLattice cells;
    std::vector<unsigned char> found(size);
    this->sampleGas(lattice, refractivity, found.data(), isKept ? &cells : nullptr);
    this->Boundary->sample(lattice, found.data(), places, distances);
    if (isKept)
    {
      this->Lattices->keep(lattice, cachedLattice(std::move(cells), places, distances, size));
    }
  }
}

} // namespace filters
