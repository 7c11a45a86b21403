// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Bench/Patches.h"
#include "Schlieren.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace schlieren
{

/// What the rays of a pixel show of an edge.
struct RaysOfPixel
{
  float blocked;   ///< the fraction that bodies stop
  double moved[2]; ///< the light of others, on the film, pixels
};

/// Pixels that edges of bodies light.
class EdgePixels
{
public:
  EdgePixels() = default;
  /// `rays`: of a rectangle of so many columns and of `around` pixels on all of its sides, row by row.
  EdgePixels(const std::vector<RaysOfPixel>& rays, std::int64_t columns, std::int64_t around);

  /// Whether a pixel of the rectangle, or around it, is beside an edge, or the light of one that is may land there. Beside an edge
  /// are pixels that, with the eight around them, have rays that bodies stop and others.
  bool isLit(std::int64_t column, std::int64_t row) const { return lit_[at(column, row)]; }
  /// Whether the light of a pixel's rays may land in one of these.
  bool hasRays(std::int64_t column, std::int64_t row) const { return lighting_[at(column, row)]; }
  bool operator==(const EdgePixels& other) const
  {
    return lit_ == other.lit_ && lighting_ == other.lighting_;
  }

private:
  std::size_t at(std::int64_t column, std::int64_t row) const
  {
    return static_cast<std::size_t>((row + around_) * stride_ + column + around_);
  }

  std::int64_t around_ = 0, stride_ = 0;
  std::vector<bool> lit_, lighting_;
};

/// Where pixels are exposed that edges light: squares as large as a patch, those in a row or a column as one rectangle.
struct EdgeTiles
{
  /// Pixels around a tile whose rays may light it, where light is moved by so many.
  static std::int64_t marginFor(double moved)
  {
    return static_cast<std::int64_t>(std::ceil(reachOfRays + moved));
  }
  /// How far the light of a pixel's rays, around its middle, is from the middles of pixels in which some of it may land: both are a
  /// pixel wide, and light may be spread.
  static constexpr double reachOfRays = 1.25;

  /// Whether edges may have rays of their own: of images in focus, whose light is moved by few pixels.
  static bool arePossible(const Scene& scene, const Light& light, double moved);

  static PatchList in(const EdgePixels& pixels, const View& view, double moved);
};

/// Where the rays of tiles start: rectangles that cover what has rays of the tiles and their margins once, as those of neighbours
/// overlap.
class RaysOfTiles
{
public:
  RaysOfTiles(PatchList::const_iterator first, PatchList::const_iterator end,
    const EdgePixels& pixels, int samples);

  /// Without margins. What is traced are all passes of the first one, then those of the next.
  const PatchList& rectangles() const { return rectangles_; }
  /// The number, among those that are traced, of the ray of a pass that starts in a pixel of a tile or its margin; none where it
  /// has no rays.
  std::optional<std::size_t> ray(std::int64_t column, std::int64_t row, int pass) const;

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
