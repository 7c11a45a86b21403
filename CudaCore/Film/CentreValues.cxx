// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/CentreValues.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <cstddef>

namespace schlieren
{

CentreArrays centreArraysOf(Image& image, std::size_t pixels)
{
  image.deflection = PixelArray<float>(2 * pixels);
  image.displacement = PixelArray<float>(2 * pixels);
  image.opticalPathDifference = PixelArray<double>(pixels);
  image.blockedFraction = PixelArray<float>(pixels);
  return { image.deflection.data(), image.displacement.data(), image.opticalPathDifference.data(),
    image.blockedFraction.data() };
}

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
          const std::int64_t pixel = row * width_ + column;
          PixelRays ofPixel =
            pixels_.empty() ? PixelRays{} : pixels_[static_cast<std::size_t>(pixel)];
          for (const TracedRays& rays : passes)
          {
            ofPixel.add(rays.exits[rays.rayOf(column, row)], areAllWanted_);
          }
          use(pixel, ofPixel);
        }
      }
    });
}

void CentreValues::add(const std::vector<TracedRays>& passes)
{
  pixels_.resize(static_cast<std::size_t>(width_ * height_));
  forEachPixel(passes,
    [this](std::int64_t pixel, const PixelRays& rays)
    { pixels_[static_cast<std::size_t>(pixel)] = rays; });
}

void CentreValues::develop(const std::vector<TracedRays>& last, Image& image) const
{
  const CentreArrays arrays = centreArraysOf(image, static_cast<std::size_t>(width_ * height_));
  forEachPixel(
    last, [&arrays](std::int64_t pixel, const PixelRays& rays) { arrays.set(pixel, rays); });
}

} // namespace schlieren
