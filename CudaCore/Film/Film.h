// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/Splat.h"
#include "PixelArray.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace schlieren
{

/// The picture being summed up, by several threads at once: each adds to a FilmBand of its own.
class Film
{
public:
  /// `mostRays`: no more rays than this will be splatted; they cannot overflow a pixel.
  Film(int width, int height, std::int64_t mostRays);

  std::int64_t width() const { return width_; }
  std::int64_t height() const { return height_; }
  std::size_t pixels() const { return pixels_.size(); }
  double one() const { return one_; } ///< the fixed-point value of a full ray

  /// The light of all pixels, row by row, in fixed point.
  const std::vector<std::int64_t>& light() const { return pixels_; }
  void setLight(std::vector<std::int64_t> light) { pixels_ = std::move(light); }

  /// Light per pixel divided by `raysPerPixel`.
  PixelArray<float> develop(double raysPerPixel, int threads) const;

private:
  friend class FilmBand;

  /// Adds light to the pixels of a row from `column` on.
  void add(std::int64_t row, std::int64_t column, const std::int64_t* light, std::int64_t count);

  std::int64_t width_;
  std::int64_t height_;
  double one_;
  std::vector<std::int64_t> pixels_;
  std::vector<std::mutex> locks_; ///< of some rows each
};

/// Some rows of a film, which one thread adds light to without regard to others, at a fraction of the
/// cost of atomic sums. Merged into the film as it moves on, and at its end.
class FilmBand
{
public:
  explicit FilmBand(Film& film);
  ~FilmBand() { merge(); }
  FilmBand(const FilmBand&) = delete;
  FilmBand& operator=(const FilmBand&) = delete;

  /// Makes footprints of rows `lowest` ... `highest` quick to add to; others remain possible.
  void cover(std::int64_t lowest, std::int64_t highest);

  /// Adds light (0...1) to the pixels of a footprint on the film.
  void splat(const Footprint& at, double light)
  {
    const Shares shares = sharesOf(at, light, one_);
    if (at.row >= begin_ && at.row + 1 < end_)
    {
      std::int64_t* lower = rowOf(at.row) + at.column + 1;
      std::int64_t* upper = lower + columns_;
      lower[0] += shares.lowerLeft;
      lower[1] += shares.lowerRight;
      upper[0] += shares.upperLeft;
      upper[1] += shares.upperRight;
      return;
    }
    addAlone(at, shares);
  }

private:
  std::int64_t* rowOf(std::int64_t row)
  {
    return light_.data() + static_cast<std::size_t>((row - first_) * columns_);
  }
  void addAlone(const Footprint& at, const Shares& shares);
  void merge();

  Film& film_;
  double one_;
  std::int64_t columns_;             ///< the film's, and one more on either side
  std::int64_t first_ = 0;           ///< row of the film that light_ begins with
  std::int64_t begin_ = 0, end_ = 0; ///< rows in use
  std::vector<std::int64_t> light_;
};

} // namespace schlieren
