// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/RayExit.h"
#include "Schlieren.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// Means, pixel by pixel, of what the rays that start there carry. Each pixel is summed in the order
/// of the passes, so that no result depends on the number of threads.
class PixelMeans
{
public:
  explicit PixelMeans(std::size_t pixels)
    : sums_(pixels)
  {
  }

  void add(std::size_t pixel, const RayExit& exit);

  /// Writes the means into the image. Pixels from which no ray reaches the film hold 0.
  void develop(Image& image) const;

private:
  struct Sums
  {
    double deflection[2]{ 0, 0 };
    double displacement[2]{ 0, 0 };
    double opticalPathDifference = 0;
    std::int32_t reached = 0;
    std::int32_t blocked = 0;
    std::int32_t rays = 0;
  };
  std::vector<Sums> sums_;
};

} // namespace schlieren
