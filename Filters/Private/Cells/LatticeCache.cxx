// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/LatticeCache.h"

#include <algorithm>
#include <utility>

namespace filters
{

void CachedLattice::copyTo(schlieren::Place* toPlaces, float* toDistances, std::size_t points) const
{
  std::fill_n(toPlaces, points, schlieren::Place::Gas);
  std::copy(this->places.begin(), this->places.end(), toPlaces);
  std::copy(this->distances.begin(), this->distances.end(), toDistances);
}

CachedLattice cachedLattice(
  CellsOfLattice cells, const schlieren::Place* places, const float* distances, std::size_t points)
{
  CachedLattice known{ std::move(cells), {}, {} };
  if (!std::all_of(places, places + points,
        [](schlieren::Place place) { return place == schlieren::Place::Gas; }))
  {
    known.places.assign(places, places + points);
  }
  if (distances)
  {
    known.distances.assign(distances, distances + points);
  }
  return known;
}

LatticeCache::Key LatticeCache::keyOf(const schlieren::Lattice& lattice, bool hasDistances)
{
  Key key;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    key[axis] = lattice.first[axis];
    key[axis + 3] = lattice.spacing[axis];
    key[axis + 6] = lattice.points[axis];
  }
  key[9] = hasDistances ? 1 : 0;
  return key;
}

std::size_t LatticeCache::bytesOf(const CachedLattice& known)
{
  return known.cells.bytes() + known.places.size() + known.distances.size() * sizeof(float) +
    sizeof(Key) + sizeof(Entry) + sizeof(CachedLattice);
}

std::shared_ptr<const CachedLattice> LatticeCache::find(
  const schlieren::Lattice& lattice, bool hasDistances)
{
  const std::lock_guard<std::mutex> lock(this->One);
  const auto entry = this->Entries.find(keyOf(lattice, hasDistances));
  if (entry == this->Entries.end())
  {
    return nullptr;
  }
  entry->second.step = this->Step;
  return entry->second.known;
}

bool LatticeCache::hasRoomFor(const schlieren::Lattice& lattice) const
{
  return lattice.size() <= CellsOfLattice::maxPoints && this->bytes() < maxBytes;
}

void LatticeCache::keep(const schlieren::Lattice& lattice, CachedLattice known)
{
  const Key key = keyOf(lattice, !known.distances.empty());
  const std::size_t bytes = bytesOf(known);
  const std::lock_guard<std::mutex> lock(this->One);
  const auto [entry, isNew] = this->Entries.try_emplace(key);
  if (isNew)
  {
    entry->second = { std::make_shared<CachedLattice>(std::move(known)), this->Step };
    this->Bytes += bytes;
  }
}

void LatticeCache::beginStep()
{
  const std::lock_guard<std::mutex> lock(this->One);
  for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
  {
    if (entry->second.step + 1 >= this->Step)
    {
      ++entry;
      continue;
    }
    this->Bytes -= bytesOf(*entry->second.known);
    entry = this->Entries.erase(entry);
  }
  ++this->Step;
}

std::size_t LatticeCache::bytes() const
{
  const std::lock_guard<std::mutex> lock(this->One);
  return this->Bytes;
}

} // namespace filters
