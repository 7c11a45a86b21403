// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/RayExit.h"
#include "Schlieren.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace schlieren
{

/// Sums of what the rays that start in a pixel carry.
struct PixelSums
{
  double deflection[2]{ 0, 0 };
  double displacement[2]{ 0, 0 };
  double opticalPathDifference = 0;
  std::int32_t reached = 0; ///< the film
  std::int32_t blocked = 0;
  std::int32_t rays = 0;

  SCHLIEREN_HD void add(const RayExit& exit)
  {
    ++rays;
    blocked += exit.fate == RayFate::Blocked ? 1 : 0;
    if (exit.reachesFilm())
    {
      ++reached;
      for (int axis = 0; axis < 2; ++axis)
      {
        deflection[axis] += exit.deflection[axis];
        displacement[axis] += exit.displacement[axis];
      }
      opticalPathDifference += exit.opticalPathDifference;
    }
  }
};

/// Means, pixel by pixel. Each pixel is summed in the order of the passes, so that no result depends on
/// the number of threads, or on the device.
class PixelMeans
{
public:
  explicit PixelMeans(std::size_t pixels)
    : sums_(pixels)
  {
  }

  void add(std::size_t pixel, const RayExit& exit) { sums_[pixel].add(exit); }

  /// Puts the sums of all pixels in the place of those so far.
  void set(std::vector<PixelSums> sums) { sums_ = std::move(sums); }

  /// Writes the means into the image. Pixels from which no ray reaches the film hold 0.
  void develop(Image& image) const;

private:
  std::vector<PixelSums> sums_;
};

} // namespace schlieren
