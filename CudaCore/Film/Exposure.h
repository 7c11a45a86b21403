// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/Film.h"
#include "Film/Shading.h"
#include "Optics/Cutoffs.h"
#include "Optics/Tint.h"
#include "PixelArray.h"
#include "Rays/TracedRays.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace schlieren
{

/// A picture in tinted light: red, green and blue.
struct ColorFilm
{
  ColorFilm(const Tint& tintOfRays, int width, int height, std::int64_t mostRays);

  /// Three values per pixel.
  PixelArray<float> develop(double raysPerPixel, int threads) const;

  Tint tint;
  std::array<Film, 3> channels;
};

/// What became of rays.
struct RayCounts
{
  std::int64_t crossed = 0; ///< met the grid
  std::int64_t steps = 0;
  std::int64_t blocked = 0;
  std::int64_t lost = 0; ///< trapped or turned

  SCHLIEREN_HD void add(const RayExit& exit)
  {
    crossed += exit.fate != RayFate::Missed ? 1 : 0;
    steps += exit.steps;
    if (!exit.reachesFilm())
    {
      ++(exit.fate == RayFate::Blocked ? blocked : lost);
    }
  }
  void add(const RayCounts& other)
  {
    crossed += other.crossed;
    steps += other.steps;
    blocked += other.blocked;
    lost += other.lost;
  }
};

/// Adds to the films the light of rays that start in the picture or up to `margin` pixels around it; their
/// passes cover that. `colorFilm`: null where nothing tints.
RayCounts expose(const std::vector<TracedRays>& passes, const Cutoffs& cutoff,
  const Projection& projection, std::int64_t margin, int threads, Film& film, ColorFilm* colorFilm);

} // namespace schlieren
