// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/Film.h"
#include "Film/PixelArray.h"
#include "Film/Shading.h"
#include "Optics/Cutoffs.h"
#include "Rays/TracedRays.h"
#include "Types.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// The films of an image: of one for light, or of three for linear red, green and blue.
struct Films
{
  /// `channels` of the cutoff, 1 or 3.
  Films(int channels, int width, int height, std::int64_t maxRays);

  bool isColored() const { return planes.size() > 1; }

  /// One value per pixel; of an image in colour, its luminance.
  PixelArray<float> developIntensity(double raysPerPixel, int threads) const;
  /// Balances that image's light; `raysPerPixel` as above.
  LightBalance balance(double raysPerPixel) const;
  /// Three values per pixel.
  PixelArray<float> developColor(double raysPerPixel, int threads) const;

  std::vector<Film> planes;
};

/// What became of rays.
struct RayCounts
{
  std::int64_t crossed = 0; ///< met the grid
  std::int64_t steps = 0;
  std::int64_t blocked = 0;
  std::int64_t lost = 0;      ///< trapped or turned
  std::int64_t shaded = 0;    ///< started in the image and reach the film
  std::int64_t saturated = 0; ///< of these, by their cutoff

  SCHLIEREN_HD void add(const RayExit& exit)
  {
    crossed += exit.fate != RayFate::Missed ? 1 : 0;
    steps += exit.steps;
    if (!exit.reachesFilm())
    {
      ++(exit.fate == RayFate::Blocked ? blocked : lost);
    }
  }
  /// Counts a ray that starts in the image.
  template <class CutoffKind>
  SCHLIEREN_HD void addShaded(const RayExit& exit, const CutoffKind& cutoff)
  {
    if (exit.reachesFilm())
    {
      ++shaded;
      saturated += cutoff.saturates(exit.deflection) ? 1 : 0;
    }
  }
  void add(const RayCounts& other)
  {
    crossed += other.crossed;
    steps += other.steps;
    blocked += other.blocked;
    lost += other.lost;
    shaded += other.shaded;
    saturated += other.saturated;
  }

  double saturatedFraction() const
  {
    return shaded > 0 ? static_cast<double>(saturated) / static_cast<double>(shaded) : 0;
  }
};

/// Adds to the films the light of rays that start in the image or up to `margin` pixels around it; their
/// passes cover that.
RayCounts expose(const std::vector<TracedRays>& passes, const Cutoffs& cutoff,
  const Projection& projection, std::int64_t margin, int threads, Films& films);

/// The same in pieces, of rays from row `firstRow` on (0 at first), which becomes the one to continue with: 0 once all
/// is done. The films hold whole passes only then. At least some rows are done, whatever the monitor says.
RayCounts exposeFrom(std::int64_t& firstRow, const std::vector<TracedRays>& passes,
  const Cutoffs& cutoff, const Projection& projection, std::int64_t margin, int threads,
  Films& films, const Monitor& monitor);

} // namespace schlieren
