// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Film.h"

#include "Film/Splat.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

Film::Film(int width, int height, std::int64_t mostRays)
  : width_(width)
  , height_(height)
  , pixels_(static_cast<std::size_t>(width_ * height_))
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

void Film::splat(double column, double row, double light)
{
  if (!isOnFilm(column, row, width_, height_))
  {
    return;
  }
  const Footprint at = footprintOf(column, row);
  const Shares shares = sharesOf(at, light, one_);
  add(at.column, at.row, shares.lowerLeft);
  add(at.column + 1, at.row, shares.lowerRight);
  add(at.column, at.row + 1, shares.upperLeft);
  add(at.column + 1, at.row + 1, shares.upperRight);
}

void Film::add(std::int64_t column, std::int64_t row, std::int64_t light)
{
  if (light != 0 && column >= 0 && column < width_ && row >= 0 && row < height_)
  {
    pixels_[static_cast<std::size_t>(row * width_ + column)].fetch_add(
      light, std::memory_order_relaxed);
  }
}

std::vector<std::int64_t> Film::light() const { return { pixels_.begin(), pixels_.end() }; }

void Film::setLight(const std::vector<std::int64_t>& light)
{
  std::copy(light.begin(), light.end(), pixels_.begin());
}

std::vector<float> Film::develop(double raysPerPixel) const
{
  std::vector<float> picture(pixels_.size());
  const double scale = 1 / (one_ * raysPerPixel);
  std::transform(pixels_.begin(), pixels_.end(), picture.begin(),
    [scale](const std::atomic<std::int64_t>& light)
    { return static_cast<float>(static_cast<double>(light.load()) * scale); });
  return picture;
}

} // namespace schlieren
