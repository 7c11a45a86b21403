// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Divides a ray's light between pixels (cloud in cell, Birdsall & Fuss 1969), in fixed point: sums of
// integers are exact, so an image does not depend on the order in which threads add to it.
#pragma once

#include "Math/HostDevice.h"

#include <cstdint>

namespace schlieren
{

/// What light is deposited in, in fixed point. `one`: the value of a full ray.
struct FilmSize
{
  std::int64_t columns, rows;
  double one;

  SCHLIEREN_HD std::int64_t fixed(double light) const
  {
    return static_cast<std::int64_t>(light * one + 0.5);
  }
};

/// The four pixels around a point of the film, and where among them it lies. Pixel centres have whole
/// coordinates.
struct Footprint
{
  std::int64_t column, row; ///< of the lower left pixel
  double right, high;       ///< 0...1, of the distance to the pixel on the right and to that above
};

/// Whether light at a point adds to any pixel of a film. False for NaN.
SCHLIEREN_HD bool isOnFilm(double column, double row, std::int64_t width, std::int64_t height)
{
  return column > -1 && column < static_cast<double>(width) && row > -1 &&
    row < static_cast<double>(height);
}

/// Finds the footprint of a point on the film.
SCHLIEREN_HD Footprint footprintOf(double column, double row)
{
  // Coordinates are above -1, where cutting off the fraction of x + 1 is the floor, without a call.
  const auto left = static_cast<std::int64_t>(column + 1) - 1;
  const auto low = static_cast<std::int64_t>(row + 1) - 1;
  return { left, low, column - static_cast<double>(left), row - static_cast<double>(low) };
}

/// Fixed-point light of the pixels of a footprint.
struct Contributions
{
  std::int64_t lowerLeft, lowerRight, upperLeft, upperRight;
};

/// Distributes light (at most 2^52) bilinearly, without losing any to rounding.
SCHLIEREN_HD Contributions contributionsOf(const Footprint& footprint, std::int64_t whole)
{
  const auto part = [](std::int64_t light, double fraction)
  { return static_cast<std::int64_t>(static_cast<double>(light) * fraction); };
  const std::int64_t upper = part(whole, footprint.high);
  const std::int64_t lower = whole - upper;
  const std::int64_t upperRight = part(upper, footprint.right);
  const std::int64_t lowerRight = part(lower, footprint.right);
  return { lower - lowerRight, lowerRight, upper - upperRight, upperRight };
}

} // namespace schlieren
