// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/PixelArray.h"
#include "Film/Splat.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace schlieren
{

/// Fixed-point light of all rays that reach the film's plane, and of what of it falls beside the film.
struct LightSums
{
  std::int64_t emitted = 0;
  std::int64_t outside = 0;
};

/// The image being summed up, by several threads at once: each adds to a FilmBand of its own.
class Film
{
public:
  /// `maxRays`: no more light than that of as many rays will be added. It cannot overflow a pixel, nor a sum
  /// of pixels.
  Film(int width, int height, std::int64_t maxRays);

  std::int64_t width() const { return width_; }
  std::int64_t height() const { return height_; }
  std::size_t pixels() const { return pixels_.size(); }
  double one() const { return one_; } ///< the fixed-point value of a full ray

  /// The light of all pixels, row by row, in fixed point.
  const std::vector<std::int64_t>& light() const { return pixels_; }
  const LightSums& sums() const { return sums_; }
  /// Calls fill(the light of all pixels, the sums), which writes both.
  template <class Fill>
  void set(const Fill& fill)
  {
    fill(pixels_.data(), sums_);
  }

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
  LightSums sums_;
  std::vector<std::mutex> locks_; ///< of some rows each
};

/// How many passes a film is to have room for where `samples` are requested: the scale, and
/// thus the last bit of a sum, is the same for all common numbers.
inline std::int64_t passesToHold(int samples)
{
  std::int64_t passes = 4096;
  while (passes < samples)
  {
    passes *= 2;
  }
  return passes;
}

/// Some rows of a film, which one thread adds light to without regard to others, at a fraction of the
/// cost of atomic sums. Merged into the film as it moves on, and at its end.
class FilmBand
{
public:
  explicit FilmBand(Film& film);
  ~FilmBand();
  FilmBand(const FilmBand&) = delete;
  FilmBand& operator=(const FilmBand&) = delete;

  /// Makes 2 x 2 pixels whose lower ones are of rows `lowest` ... `highest` quick to add to; others remain
  /// possible.
  void cover(std::int64_t lowest, std::int64_t highest);

  /// Counts light that is then added.
  void addEmitted(std::int64_t light) { sums_.emitted += light; }
  void addOutside(std::int64_t light) { sums_.outside += light; }

  /// Adds to 2 x 2 pixels at (column, row), at least one of which is on the film.
  void add(std::int64_t column, std::int64_t row, const Contributions& contributions)
  {
    if (row >= begin_ && row + 1 < end_)
    {
      std::int64_t* lower = rowOf(row) + column + 1;
      std::int64_t* upper = lower + columns_;
      lower[0] += contributions.lowerLeft;
      lower[1] += contributions.lowerRight;
      upper[0] += contributions.upperLeft;
      upper[1] += contributions.upperRight;
      return;
    }
    addAlone(column, row, contributions);
  }

  /// Adds to a pixel of the film.
  void add(std::int64_t column, std::int64_t row, std::int64_t light)
  {
    if (row >= begin_ && row < end_)
    {
      rowOf(row)[column + 1] += light;
      return;
    }
    film_.add(row, column, &light, 1);
  }

private:
  std::int64_t* rowOf(std::int64_t row)
  {
    return light_.data() + static_cast<std::size_t>((row - first_) * columns_);
  }
  void addAlone(std::int64_t column, std::int64_t row, const Contributions& contributions);
  void merge();

  Film& film_;
  LightSums sums_;
  std::int64_t columns_;             ///< the film's, and one more on either side
  std::int64_t first_ = 0;           ///< row of the film that light_ begins with
  std::int64_t begin_ = 0, end_ = 0; ///< rows in use
  std::vector<std::int64_t> light_;
};

} // namespace schlieren
