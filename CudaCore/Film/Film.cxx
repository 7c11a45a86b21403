// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/Film.h"

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
  // Also false for NaN.
  if (!(column > -1 && column < static_cast<double>(width_) && row > -1 &&
        row < static_cast<double>(height_)))
  {
    return;
  }
  const double left = std::floor(column);
  const double low = std::floor(row);
  const double right = column - left;
  const double high = row - low;
  const auto whole = static_cast<std::uint64_t>(std::llround(light * one_));
  const auto upper = static_cast<std::uint64_t>(static_cast<double>(whole) * high);
  const auto upperRight = static_cast<std::uint64_t>(static_cast<double>(upper) * right);
  const std::uint64_t lower = whole - upper;
  const auto lowerRight = static_cast<std::uint64_t>(static_cast<double>(lower) * right);
  const auto i = static_cast<std::int64_t>(left);
  const auto j = static_cast<std::int64_t>(low);
  add(i, j, lower - lowerRight);
  add(i + 1, j, lowerRight);
  add(i, j + 1, upper - upperRight);
  add(i + 1, j + 1, upperRight);
}

void Film::add(std::int64_t column, std::int64_t row, std::uint64_t light)
{
  if (light != 0 && column >= 0 && column < width_ && row >= 0 && row < height_)
  {
    pixels_[static_cast<std::size_t>(row * width_ + column)].fetch_add(
      light, std::memory_order_relaxed);
  }
}

std::vector<float> Film::develop(double raysPerPixel) const
{
  std::vector<float> picture(pixels_.size());
  const double scale = 1 / (one_ * raysPerPixel);
  std::transform(pixels_.begin(), pixels_.end(), picture.begin(),
    [scale](const std::atomic<std::uint64_t>& light)
    { return static_cast<float>(static_cast<double>(light.load()) * scale); });
  return picture;
}

} // namespace schlieren
