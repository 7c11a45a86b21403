// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How rays that are traced together are divided.
#pragma once

#include "Rays/RayExit.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// Squares of pixels that a thread of a CPU takes at once: their rays read the same samples of the medium.
constexpr std::int64_t tileEdge = 16;
/// Rows of a pass that a launch on a GPU has at least: a band.
constexpr std::int64_t bandRows = 8;

/// Tiles: first, first + step, and so on, up to the end.
struct Tiles
{
  std::int64_t first, end;
  std::int64_t step = 1;

  std::int64_t count() const { return (std::max(first, end) - first + step - 1) / step; }
};

/// Which of the tiles first ... end - 1 one of `processes` ranks traces: every nth one, whatever the range is.
inline Tiles tilesOfProcess(
  std::int64_t first, std::int64_t end, std::int64_t process, std::int64_t processes)
{
  const std::int64_t next = (first - process + processes - 1) / processes;
  return { process + std::max<std::int64_t>(0, next) * processes, end, processes };
}

/// A pass among others, and how many rays, tiles and bands are before its own.
struct PlacedPass
{
  Pass pass;
  std::int64_t firstRay = 0, firstTile = 0, firstBand = 0;

  std::int64_t tilesAlong() const { return (pass.columns + tileEdge - 1) / tileEdge; }
  std::int64_t tiles() const { return tilesAlong() * ((pass.rows + tileEdge - 1) / tileEdge); }
  std::int64_t bands() const { return (pass.rows + bandRows - 1) / bandRows; }
};

/// The rays of a tile: from which column and row of its pass on.
struct TileOfPass
{
  const PlacedPass& of;
  std::int64_t left, low, columns, rows;
};

/// Passes that are traced together, an image's or those of patches of it. Their rays are one after the other, those of a pass
/// row by row, and so are their tiles and bands.
class Passes
{
public:
  Passes(const Pass& one) // a pass is what most have
    : Passes(std::vector<Pass>{ one })
  {
  }
  Passes(const std::vector<Pass>& all)
  {
    for (const Pass& pass : all)
    {
      placed_.push_back({ pass, rays_, tiles_, bands_ });
      rays_ += pass.columns * pass.rows;
      tiles_ += placed_.back().tiles();
      bands_ += placed_.back().bands();
      columns_ = std::max(columns_, pass.columns);
    }
  }

  const std::vector<PlacedPass>& all() const { return placed_; }
  std::size_t rays() const { return static_cast<std::size_t>(rays_); }
  std::int64_t tiles() const { return tiles_; }
  std::int64_t bands() const { return bands_; }
  std::int64_t columns() const { return columns_; } ///< of the widest

  TileOfPass tile(std::int64_t number) const
  {
    const PlacedPass& of = before(number, &PlacedPass::firstTile);
    const std::int64_t inPass = number - of.firstTile;
    const std::int64_t left = inPass % of.tilesAlong() * tileEdge;
    const std::int64_t low = inPass / of.tilesAlong() * tileEdge;
    return { of, left, low, std::min(tileEdge, of.pass.columns - left),
      std::min(tileEdge, of.pass.rows - low) };
  }
  std::size_t raysOf(const Tiles& tiles) const
  {
    std::int64_t rays = 0;
    for (std::int64_t number = tiles.first; number < tiles.end; number += tiles.step)
    {
      const TileOfPass of = tile(number);
      rays += of.columns * of.rows;
    }
    return static_cast<std::size_t>(rays);
  }

  std::size_t raysBefore(std::int64_t band) const
  {
    if (band >= bands_)
    {
      return rays();
    }
    const PlacedPass& of = before(band, &PlacedPass::firstBand);
    return static_cast<std::size_t>(
      of.firstRay + (band - of.firstBand) * bandRows * of.pass.columns);
  }

private:
  /// The last pass with no more before it than that.
  const PlacedPass& before(std::int64_t number, std::int64_t PlacedPass::*first) const
  {
    return *(std::upper_bound(placed_.begin(), placed_.end(), number,
               [first](std::int64_t value, const PlacedPass& one) { return value < one.*first; }) -
      1);
  }

  std::vector<PlacedPass> placed_;
  std::int64_t rays_ = 0, tiles_ = 0, bands_ = 0, columns_ = 0;
};

} // namespace schlieren
