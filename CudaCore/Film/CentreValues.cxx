// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/CentreValues.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <cstddef>

namespace schlieren
{

template <class Use>
void CentreValues::forEachPixel(const std::vector<TracedRays>& passes, const Use& use) const
{
  constexpr std::int64_t rowsPerPiece = 16;
  parallelFor(height_, rowsPerPiece, threads_,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t row = begin; row < end; ++row)
      {
        for (std::int64_t column = 0; column < width_; ++column)
        {
          const auto pixel = static_cast<std::size_t>(row * width_ + column);
          PixelRays ofPixel = pixels_.empty() ? PixelRays{} : pixels_[pixel];
          for (const TracedRays& rays : passes)
          {
            ofPixel.add(rays.exits[rays.rayOf(column, row)]);
          }
          use(pixel, ofPixel);
        }
      }
    });
}

void CentreValues::add(const std::vector<TracedRays>& passes)
{
  pixels_.resize(static_cast<std::size_t>(width_ * height_));
  forEachPixel(passes, [this](std::size_t pixel, const PixelRays& rays) { pixels_[pixel] = rays; });
}

void CentreValues::develop(const std::vector<TracedRays>& last, Image& image)
{
  const auto pixels = static_cast<std::size_t>(width_ * height_);
  image.deflection = PixelArray<float>(2 * pixels);
  image.displacement = PixelArray<float>(2 * pixels);
  image.opticalPathDifference = PixelArray<double>(pixels);
  image.blockedFraction = PixelArray<float>(pixels);
  forEachPixel(last,
    [&image](std::size_t pixel, const PixelRays& rays)
    {
      // A division takes as long as all the rest, and most pixels need none.
      const double perRay = rays.summed > 1 ? 1. / rays.summed : 1;
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        image.deflection[2 * pixel + axis] = static_cast<float>(rays.deflection[axis] * perRay);
        image.displacement[2 * pixel + axis] = static_cast<float>(rays.displacement[axis] * perRay);
      }
      image.opticalPathDifference[pixel] =
        rays.summed > 1 ? rays.opticalPathDifference / rays.summed : rays.opticalPathDifference;
      image.blockedFraction[pixel] =
        rays.blocked > 0 ? static_cast<float>(rays.blocked) / static_cast<float>(rays.rays) : 0;
    });
}

} // namespace schlieren
