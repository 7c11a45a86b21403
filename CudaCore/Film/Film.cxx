// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Film.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace schlieren
{

namespace
{

constexpr std::int64_t rowsPerLock = 16;

/// Rows of a band: as many as the rays of some rows of pixels commonly land in.
constexpr std::int64_t bandRows = 64;

} // namespace

Film::Film(int width, int height, std::int64_t maxRays)
  : width_(width)
  , height_(height)
  , pixels_(static_cast<std::size_t>(width_ * height_))
  , locks_(static_cast<std::size_t>((height_ + rowsPerLock - 1) / rowsPerLock))
{
  constexpr int usableBits = 63;
  constexpr int maxFractionBits = 40;
  int rayBits = 1;
  while (rayBits < usableBits && (maxRays >> rayBits) != 0)
  {
    ++rayBits;
  }
  one_ = std::ldexp(1.0, std::min(maxFractionBits, usableBits - rayBits));
}

void Film::add(std::int64_t row, std::int64_t column, const std::int64_t* light, std::int64_t count)
{
  const std::lock_guard<std::mutex> guard(locks_[static_cast<std::size_t>(row / rowsPerLock)]);
  std::int64_t* pixels = pixels_.data() + row * width_ + column;
  std::transform(pixels, pixels + count, light, pixels, std::plus<>());
}

PixelArray<float> Film::develop(double raysPerPixel, int threads) const
{
  PixelArray<float> image(pixels_.size());
  const double scale = 1 / (one_ * raysPerPixel);
  constexpr std::int64_t pixelsPerPiece = 1 << 15;
  parallelFor(static_cast<std::int64_t>(pixels_.size()), pixelsPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::transform(pixels_.begin() + begin, pixels_.begin() + end, image.data() + begin,
        [scale](std::int64_t light)
        { return static_cast<float>(static_cast<double>(light) * scale); });
    });
  return image;
}

FilmBand::FilmBand(Film& film)
  : film_(film)
  , columns_(film.width_ + 2)
  , light_(static_cast<std::size_t>(bandRows * columns_))
{
}

FilmBand::~FilmBand()
{
  merge();
  const std::lock_guard<std::mutex> guard(film_.locks_[0]);
  film_.sums_.emitted += sums_.emitted;
  film_.sums_.outside += sums_.outside;
}

void FilmBand::cover(std::int64_t lowest, std::int64_t highest)
{
  const std::int64_t spare = bandRows - (highest + 2 - lowest);
  const bool isCovered = lowest >= first_ && highest + 2 <= first_ + bandRows;
  const bool isAllOfUse = lowest <= first_ && highest + 2 >= first_ + bandRows;
  if (!isCovered && !isAllOfUse)
  {
    merge();
    // Rays mostly go up the image, and some come back a little.
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
      sums_.outside += light[0] + light[columns_ - 1];
    }
    else
    {
      sums_.outside += std::accumulate(light, light + columns_, std::int64_t{ 0 });
    }
    std::fill_n(light, columns_, 0);
  }
  begin_ = end_ = first_;
}

void FilmBand::addAlone(std::int64_t column, std::int64_t row, const Contributions& contributions)
{
  const std::int64_t lights[2][2] = { { contributions.lowerLeft, contributions.lowerRight },
    { contributions.upperLeft, contributions.upperRight } };
  for (std::int64_t j = 0; j < 2; ++j)
  {
    for (std::int64_t i = 0; i < 2; ++i)
    {
      const bool isOnIt =
        column + i >= 0 && column + i < film_.width_ && row + j >= 0 && row + j < film_.height_;
      if (isOnIt)
      {
        add(column + i, row + j, lights[j][i]);
      }
      else
      {
        addOutside(lights[j][i]);
      }
    }
  }
}

} // namespace schlieren
