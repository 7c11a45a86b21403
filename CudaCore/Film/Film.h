// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// The picture being summed up. Light is counted in 64-bit fixed point: sums are exact, so a picture
/// does not depend on the order in which threads add to it.
class Film
{
public:
  /// `mostRays`: no more rays than this will be splatted; they cannot overflow a pixel.
  Film(int width, int height, std::int64_t mostRays);

  /// Shares light (0...1) among the four pixels around a point, bilinearly (cloud in cell, Birdsall &
  /// Fuss 1969), without losing any to rounding. Pixel centres have whole coordinates. What falls
  /// outside the picture is dropped. May be called by several threads at once.
  void splat(double column, double row, double light);

  std::int64_t width() const { return width_; }
  std::int64_t height() const { return height_; }
  /// The fixed-point value of a full ray.
  double one() const { return one_; }

  /// The light of all pixels, row by row, in fixed point.
  std::vector<std::int64_t> light() const;
  void setLight(const std::vector<std::int64_t>& light);

  /// Light per pixel divided by `raysPerPixel`.
  std::vector<float> develop(double raysPerPixel) const;

private:
  void add(std::int64_t column, std::int64_t row, std::int64_t light);

  std::int64_t width_;
  std::int64_t height_;
  double one_; ///< fixed-point value of a full ray
  std::vector<std::atomic<std::int64_t>> pixels_;
};

} // namespace schlieren
