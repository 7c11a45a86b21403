// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/TracedRays.h"
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
  std::int32_t reached = 0;
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
        displacement[axis] += static_cast<double>(exit.displacement[axis]);
      }
      opticalPathDifference += exit.opticalPathDifference;
    }
  }
};

/// Means, pixel by pixel, of what the rays that start there carry. Each pixel is summed in the order
/// of the passes, so that no result depends on the number of threads, or on which passes come at once.
class PixelMeans
{
public:
  PixelMeans(int width, int height, int threads)
    : width_(width)
    , height_(height)
    , threads_(threads)
  {
  }

  /// Adds passes that more will follow.
  void add(const std::vector<TracedRays>& passes);

  /// Takes the sums of all pixels, row by row, from a device that has added passes.
  void setSums(std::vector<PixelSums> sums) { sums_ = std::move(sums); }

  /// Adds the last passes and writes the means into the image. Pixels from which no ray reaches the film
  /// hold 0.
  void develop(const std::vector<TracedRays>& last, Image& image);

private:
  /// Calls use(pixel, its sums) with what it holds and these passes.
  template <class Use>
  void forEachPixel(const std::vector<TracedRays>& passes, const Use& use) const;

  std::int64_t width_;
  std::int64_t height_;
  int threads_;
  std::vector<PixelSums> sums_; ///< of what has been added; most often nothing
};

} // namespace schlieren
