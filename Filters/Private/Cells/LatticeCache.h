// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellSampler.h"

#include "Schlieren.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace filters
{

/// Results at a lattice's points that depend on the mesh alone.
struct CachedLattice
{
  CellsOfLattice cells;
  std::vector<schlieren::Place> places; // empty: all gas
  std::vector<float> distances;         // empty: not computed

  /// `toDistances`: may be null if none were computed.
  void copyTo(schlieren::Place* toPlaces, float* toDistances, std::size_t points) const;
};

/// `distances`: may be null.
CachedLattice cachedLattice(
  CellsOfLattice cells, const schlieren::Place* places, const float* distances, std::size_t points);

/**
 * Caches results on lattices of a mesh for later time steps, which use the same lattices as long as
 * the view and its content change little. Limited to `maxBytes`. Drops those that two steps have
 * not used. Thread-safe.
 */
class LatticeCache
{
public:
  static constexpr std::size_t maxBytes = std::size_t{ 1 } << 29;

  /// Returns null for unknown lattices.
  std::shared_ptr<const CachedLattice> find(const schlieren::Lattice& lattice, bool hasDistances);

  bool hasRoomFor(const schlieren::Lattice& lattice) const;
  void keep(const schlieren::Lattice& lattice, CachedLattice known);

  /// Drops lattices that the last two steps have not used.
  void beginStep();

  std::size_t bytes() const;

private:
  using Key = std::array<double, 10>;
  static Key keyOf(const schlieren::Lattice& lattice, bool hasDistances);
  static std::size_t bytesOf(const CachedLattice& known);

  struct Entry
  {
    std::shared_ptr<const CachedLattice> known;
    std::uint64_t step;
  };
  mutable std::mutex One;
  std::map<Key, Entry> Entries;
  std::size_t Bytes = 0;
  std::uint64_t Step = 0;
};

} // namespace filters
