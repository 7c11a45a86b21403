// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Film.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace schlieren
{

namespace
{

constexpr std::int64_t rowsPerLock = 16;

/// Of a band: as many as the rays of some rows of pixels commonly land in.
constexpr std::int64_t bandRows = 64;

} // namespace

Film::Film(int width, int height, std::int64_t mostRays)
  : width_(width)
  , height_(height)
  , pixels_(static_cast<std::size_t>(width_ * height_))
  , locks_(static_cast<std::size_t>((height_ + rowsPerLock - 1) / rowsPerLock))
{
  constexpr int usableBits = 63;
  constexpr int mostFractionBits = 40;
  int rayBits = 1;
  while (rayBits < usableBits && (mostRays >> rayBits) != 0)
  {
    ++rayBits;
  }
  one_ = std::ldexp(1.0, std::min(mostFractionBits, usableBits - rayBits));
}

void Film::add(std::int64_t row, std::int64_t column, const std::int64_t* light, std::int64_t count)
{
  const std::lock_guard<std::mutex> guard(locks_[static_cast<std::size_t>(row / rowsPerLock)]);
  std::int64_t* pixels = pixels_.data() + row * width_ + column;
  std::transform(pixels, pixels + count, light, pixels, std::plus<>());
}

PixelArray<float> Film::develop(double raysPerPixel, int threads) const
{
  PixelArray<float> picture(pixels_.size());
  const double scale = 1 / (one_ * raysPerPixel);
  constexpr std::int64_t pixelsPerPiece = 1 << 15;
  parallelFor(static_cast<std::int64_t>(pixels_.size()), pixelsPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::transform(pixels_.begin() + begin, pixels_.begin() + end, picture.data() + begin,
        [scale](std::int64_t light)
        { return static_cast<float>(static_cast<double>(light) * scale); });
    });
  return picture;
}

FilmBand::FilmBand(Film& film)
  : film_(film)
  , one_(film.one_)
  , columns_(film.width_ + 2)
  , light_(static_cast<std::size_t>(bandRows * columns_))
{
}

void FilmBand::cover(std::int64_t lowest, std::int64_t highest)
{
  const std::int64_t spare = bandRows - (highest + 2 - lowest);
  const bool isCovered = lowest >= first_ && highest + 2 <= first_ + bandRows;
  const bool isAllOfUse = lowest <= first_ && highest + 2 >= first_ + bandRows;
  if (!isCovered && !isAllOfUse)
  {
    merge();
    // Rays mostly go up the picture, and some come back a little.
    first_ = lowest - std::clamp<std::int64_t>(spare / 4, 0, 8);
    begin_ = end_ = lowest;
  }
  begin_ = std::clamp(lowest, first_, begin_);
  end_ = std::clamp(highest + 2, end_, first_ + bandRows);
}

void FilmBand::merge()
{
  for (std::int64_t row = begin_; row < end_; ++row)
  {
    std::int64_t* light = rowOf(row);
    if (row >= 0 && row < film_.height_)
    {
      film_.add(row, 0, light + 1, film_.width_);
    }
    std::fill_n(light, columns_, 0);
  }
  begin_ = end_ = first_;
}

void FilmBand::addAlone(const Footprint& at, const Shares& shares)
{
  const std::array<std::int64_t, 2> lower = { shares.lowerLeft, shares.lowerRight };
  const std::array<std::int64_t, 2> upper = { shares.upperLeft, shares.upperRight };
  const std::int64_t first = std::max<std::int64_t>(at.column, 0);
  const std::int64_t count = std::min(at.column + 2, film_.width_) - first;
  if (at.row >= 0)
  {
    film_.add(at.row, first, lower.data() + (first - at.column), count);
  }
  if (at.row + 1 < film_.height_)
  {
    film_.add(at.row + 1, first, upper.data() + (first - at.column), count);
  }
}

} // namespace schlieren
