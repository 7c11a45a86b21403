// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/Shading.h"
#include "Film/Splat.h"
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

/// Splatting (FilmEstimator::Photon): distributes the light of a ray over the four pixels around. A `Deposit` takes it plane by
/// plane:
///   emitted(plane, light)                 before it is divided;
///   pixel(plane, column, row, light)      on the film;
///   block(plane, column, row, parts)      of 2 x 2 pixels, some of which may be outside;
///   outside(plane, light)                 that falls on no pixel.
/// What is emitted arrives in pixels and outside, to the last bit.
template <int planes, class Deposit>
SCHLIEREN_HD void addPhoton(const FilmRay<planes>& ray, const FilmSize& film, Deposit& deposit)
{
  if (!ray.arrives)
  {
    return;
  }
  const double column = ray.x - 0.5, row = ray.y - 0.5; // from the first pixel's centre
  const bool isNear = isOnFilm(column, row, film.columns, film.rows);
  for (int plane = 0; plane < planes; ++plane)
  {
    const std::int64_t whole = film.fixed(ray.light[plane]);
    deposit.emitted(plane, whole);
    if (isNear)
    {
      const Footprint at = footprintOf(column, row);
      deposit.block(plane, at.column, at.row, contributionsOf(at, whole));
    }
    else
    {
      deposit.outside(plane, whole);
    }
  }
}

} // namespace schlieren
