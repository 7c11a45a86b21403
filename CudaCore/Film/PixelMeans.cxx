// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Film/PixelMeans.h"

#include <algorithm>

namespace schlieren
{

void PixelMeans::develop(Image& image) const
{
  image.deflection.resize(2 * sums_.size());
  image.displacement.resize(2 * sums_.size());
  image.opticalPathDifference.resize(sums_.size());
  image.blockedFraction.resize(sums_.size());
  for (std::size_t pixel = 0; pixel < sums_.size(); ++pixel)
  {
    const PixelSums& sums = sums_[pixel];
    const double reached = std::max(sums.reached, 1);
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      image.deflection[2 * pixel + axis] = static_cast<float>(sums.deflection[axis] / reached);
      image.displacement[2 * pixel + axis] = static_cast<float>(sums.displacement[axis] / reached);
    }
    image.opticalPathDifference[pixel] = sums.opticalPathDifference / reached;
    image.blockedFraction[pixel] =
      static_cast<float>(static_cast<double>(sums.blocked) / std::max(sums.rays, 1));
  }
}

} // namespace schlieren
