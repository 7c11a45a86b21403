// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/MeanImage.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace filters
{

namespace
{

/// Updates a mean by the n-th number.
template <class Number>
void approach(Number& mean, Number number, int n)
{
  mean = static_cast<Number>(mean + (static_cast<double>(number) - mean) / n);
}

template <class Number>
void approach(
  schlieren::PixelArray<Number>& mean, const schlieren::PixelArray<Number>& numbers, int n)
{
  for (std::size_t i = 0; i < std::min(mean.size(), numbers.size()); ++i)
  {
    approach(mean[i], numbers[i], n);
  }
}

void keepLarger(schlieren::PixelArray<float>& kept, const schlieren::PixelArray<float>& others)
{
  for (std::size_t i = 0; i < std::min(kept.size(), others.size()); ++i)
  {
    kept[i] = std::max(kept[i], others[i]);
  }
}

/// Adds histograms with the same number of bins, in the bins of the larger range, which is the
/// other times a power of two. Bins that overlap two others go to the one at their centre.
void add(schlieren::Histogram& sum, schlieren::Histogram&& histogram)
{
  if (sum.range < histogram.range)
  {
    std::swap(sum, histogram);
  }
  const double shrinks = sum.range > 0 ? histogram.range / sum.range : 1;
  const auto binOf = [&](int bin)
  {
    const double fromMiddle = shrinks * (bin + 0.5 - 0.5 * histogram.size);
    const int place = static_cast<int>(fromMiddle + 0.5 * sum.size);
    return static_cast<std::size_t>(std::clamp(place, 0, sum.size - 1));
  };
  const auto rowSize = static_cast<std::size_t>(sum.size);
  for (int row = 0; row < histogram.size; ++row)
  {
    for (int column = 0; column < histogram.size; ++column)
    {
      sum.rays[binOf(row) * rowSize + binOf(column)] +=
        histogram.rays[static_cast<std::size_t>(row) * rowSize + static_cast<std::size_t>(column)];
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
void addRays(schlieren::Image& sum, const schlieren::Image& image)
{
  sum.raysTraced += image.raysTraced;
  sum.stepsTaken += image.stepsTaken;
  sum.raysBlocked += image.raysBlocked;
  sum.raysLost += image.raysLost;
  sum.traceSeconds += image.traceSeconds;
}

//------------------------------------------------------------------------------
void MeanImage::Add(schlieren::Image&& image)
{
  schlieren::Image& mean = this->Mean;
  const int n = ++this->Images;
  if (n == 1)
  {
    mean = std::move(image);
    return;
  }
  approach(mean.intensity, image.intensity, n);
  approach(mean.color, image.color, n);
  approach(mean.background, image.background, n);
  approach(mean.backgroundDisplacement, image.backgroundDisplacement, n);
  approach(mean.deflection, image.deflection, n);
  approach(mean.opticalPathDifference, image.opticalPathDifference, n);
  approach(mean.displacement, image.displacement, n);
  approach(mean.blockedFraction, image.blockedFraction, n);
  approach(mean.saturatedFraction, image.saturatedFraction, n);
  approach(mean.light.emitted, image.light.emitted, n);
  approach(mean.light.onFilm, image.light.onFilm, n);
  approach(mean.light.outside, image.light.outside, n);
  add(mean.histogram, std::move(image.histogram));
  addRays(mean, image);

  // Keeps the worst value.
  mean.pathModel = std::max(mean.pathModel, image.pathModel);
  mean.integrator = std::max(mean.integrator, image.integrator);
  mean.skippingBound = std::max(mean.skippingBound, image.skippingBound);
  mean.momentumDrift = std::max(mean.momentumDrift, image.momentumDrift);
  if (image.accuracy.reached > mean.accuracy.reached)
  {
    std::swap(mean.accuracy, image.accuracy);
  }
  keepLarger(mean.accuracy.estimate, image.accuracy.estimate);
  if (image.steepestChange > mean.steepestChange)
  {
    mean.steepestChange = image.steepestChange;
    mean.steepestPlace = image.steepestPlace;
  }
  const double error = std::max(mean.medium.estimatedError, image.medium.estimatedError);
  mean.medium = image.medium;
  mean.medium.estimatedError = error;
  mean.waves = image.waves;
  mean.lightNote = image.lightNote.empty() ? mean.lightNote : image.lightNote;
  mean.lightModel = std::min(mean.lightModel, image.lightModel);
  if (mean.deviceNote.empty())
  {
    mean.deviceNote = image.deviceNote;
  }
}

//------------------------------------------------------------------------------
schlieren::Image MeanImage::Take()
{
  this->Images = 0;
  return std::exchange(this->Mean, {});
}

} // namespace filters
