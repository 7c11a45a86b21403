// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is behind the flow of a background-oriented schlieren image (Meier 2002; Richard & Raffel 2001). A
// camera's ray has the light of the place where it meets the pattern.
#pragma once

#include "Math/HostDevice.h"
#include "Math/RandomBits.h"
#include "Math/Trigonometry.h"
#include "Optics/Color.h"
#include "Optics/ColorFilter.h"
#include "Optics/Interferogram.h"
#include "Optics/RayAtFilm.h"

#include <cmath>
#include <cstdint>

namespace schlieren
{

/// How much of a pattern an image can show: all from four pixels a period on, nothing below two, where it
/// would look like another one (aliasing).
SCHLIEREN_HD double patternContrast(double period) { return limited(0.5 * (period - 2)); }

/// Dark dots on white, one for each square cell, anywhere in it.
struct Dots
{
  static constexpr int channels = 1;

  double corner[2]; ///< of cells, pixels
  double period;    ///< edge of a cell, pixels
  std::uint32_t seed;

  // Of the dots' size, periods: so large that half of the light comes back, found by sampling.
  static constexpr double radius = 0.423; ///< where a dot lets half of the light through
  static constexpr double edge = 0.2;     ///< over which it becomes white

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    light[0] = 0.5;
    const double contrast = patternContrast(period);
    const double x = (ray.position[0] - corner[0]) / period;
    const double y = (ray.position[1] - corner[1]) / period;
    constexpr double largest = 1e15; // where cells are still distinct
    if (!(contrast > 0 && fabs(x) < largest && fabs(y) < largest))
    {
      return;
    }
    const double left = floor(x), low = floor(y);
    double white = 1;
    for (int row = -1; row <= 1; ++row)
    {
      for (int column = -1; column <= 1; ++column)
      {
        const std::uint64_t bits =
          bitsOf(static_cast<std::int64_t>(left) + column, static_cast<std::int64_t>(low) + row);
        white *= passed(bits, x - left - column, y - low - row);
      }
    }
    light[0] += contrast * (white - 0.5);
  }
  SCHLIEREN_HD bool saturates(const double (&)[2]) const { return false; }

private:
  /// Random bits of a cell.
  SCHLIEREN_HD std::uint64_t bitsOf(std::int64_t column, std::int64_t row) const
  {
    return mixed(
      mixed(mixed(seed) ^ static_cast<std::uint64_t>(column)) ^ static_cast<std::uint64_t>(row));
  }

  /// What a cell's dot lets through, at a place in periods from the cell's corner.
  SCHLIEREN_HD static double passed(std::uint64_t bits, double x, double y)
  {
    constexpr double perBit = 1. / 4294967296;
    const double besideX = x - perBit * static_cast<double>(bits >> 32);
    const double besideY = y - perBit * static_cast<double>(bits & 0xffffffffu);
    const double fraction =
      limited((sqrt(besideX * besideX + besideY * besideY) - radius) / edge + 0.5);
    return fraction * fraction * (3 - 2 * fraction);
  }
};

/// Light and dark as a cosine.
struct Stripes
{
  static constexpr int channels = 1;

  Carrier carrier; ///< whose turns are their periods
  double contrast;

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    const double sine = sinPi(fromNearestWhole(carrier.turnsAt(ray.position)));
    light[0] = 0.5 + contrast * (0.5 - sine * sine);
  }
  SCHLIEREN_HD bool saturates(const double (&)[2]) const { return false; }
};

/// An image, stretched over what the camera sees.
struct BackgroundImage
{
  static constexpr int channels = 3;

  ColorImage image;         ///< its k is 1
  double perColumn, perRow; ///< 2 / the camera's image's pixels

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    const double place[2] = { (ray.position[0] + 0.5) * perColumn - 1,
      (ray.position[1] + 0.5) * perRow - 1 };
    image.shade(RayAtFilm{ { place[0], place[1] }, 0, { 0, 0 } }, light);
  }
  SCHLIEREN_HD bool saturates(const double (&)[2]) const { return false; }
};

} // namespace schlieren
