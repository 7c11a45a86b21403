// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Bench/Patches.h"
#include "Schlieren.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// Where the pixels are that edges of bodies may cross: squares as large as a patch, those in a row or a column as one rectangle.
struct EdgeTiles
{
  /// Pixels around a tile whose rays may light it, where light is moved by so many.
  static std::int64_t marginFor(double moved)
  {
    constexpr double ofNeighbours =
      1.5; // what a ray lights is half as wide, and depends on rays beside it
    return static_cast<std::int64_t>(std::ceil(ofNeighbours + moved));
  }

  /// Whether edges may have rays of their own: of images in focus, whose light is moved by few pixels.
  static bool arePossible(const Scene& scene, const Light& light, double moved);

  /// Finds them by the fraction of rays that bodies stop in each pixel of a view, row by row: all or none of a square and the
  /// pixels beside it, or an edge is there.
  static PatchList in(const PixelArray<float>& blockedFraction, const View& view, double moved);
};

/// Where the rays of tiles start: rectangles that cover the tiles and their margins once, as those of neighbours overlap.
class RaysOfTiles
{
public:
  RaysOfTiles(PatchList::const_iterator first, PatchList::const_iterator end, int samples);

  /// Without margins. What is traced are all passes of the first one, then those of the next.
  const PatchList& rectangles() const { return rectangles_; }
  /// The number, among those that are traced, of the ray of a pass that starts in a pixel of a tile or its margin.
  std::size_t ray(std::int64_t column, std::int64_t row, int pass) const;

private:
  int& rectangleAt(std::int64_t column, std::int64_t row)
  {
    return rectangleAt_[static_cast<std::size_t>((row - low_) * columns_ + column - left_)];
  }

  std::int64_t left_, low_, columns_ = 0; ///< of all
  std::vector<int> rectangleAt_;
  PatchList rectangles_;
  std::vector<std::size_t> firstRays_; ///< of each
};

} // namespace schlieren
