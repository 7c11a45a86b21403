// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/DeflectionHistogram.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <mutex>

namespace schlieren
{

namespace
{

constexpr int exponentAtRest = -20;

/// Calls use(exit) for the rays of some rows of an image that reach the film.
template <class Use>
void forEachDeflection(const TracedRays& rays, std::int64_t firstRow, std::int64_t endRow,
  std::int64_t width, const Use& use)
{
  for (std::int64_t row = firstRow; row < endRow; ++row)
  {
    const RayExit* exits = rays.exits + rays.rayOf(0, row);
    std::for_each(exits, exits + width,
      [&use](const RayExit& exit)
      {
        if (DeflectionBins::counts(exit))
        {
          use(exit);
        }
      });
  }
}

} // namespace

void DeflectionHistogram::add(const TracedRays& rays, int width, int height, int threads)
{
  ++passes_;
  const std::int64_t rowsPerPiece = (height - 1) / threadCount(threads) + 1;
  std::mutex lock;
  double largest = 0;
  parallelFor(height, rowsPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      double here = 0;
      forEachDeflection(rays, begin, end, width,
        [&here](const RayExit& exit) {
          here =
            std::max(here, std::max(std::abs(exit.deflection[0]), std::abs(exit.deflection[1])));
        });
      const std::lock_guard<std::mutex> guard(lock);
      largest = std::max(largest, here);
    });
  growToHold(largest);
  const DeflectionBins bins = this->bins();
  const auto count = [&](std::int64_t begin, std::int64_t end, std::vector<std::int64_t>& counts)
  {
    forEachDeflection(rays, begin, end, width,
      [&](const RayExit& exit) { ++counts[static_cast<std::size_t>(bins.of(exit))]; });
  };
  if (std::int64_t{ width } * height < static_cast<std::int64_t>(counts_.size()))
  {
    count(0, height, counts_); // adding up the threads' bins would take longer
    return;
  }
  parallelFor(height, rowsPerPiece, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::vector<std::int64_t> here(counts_.size());
      count(begin, end, here);
      const std::lock_guard<std::mutex> guard(lock);
      std::transform(here.begin(), here.end(), counts_.begin(), counts_.begin(), std::plus<>());
    });
}

void DeflectionHistogram::add(const CudaPass& rays, const Pass& pass, int width, int height)
{
  ++passes_;
  growToHold(rays.largestDeflection(pass, width, height));
  rays.countDeflections(pass, width, height, bins(), counts_);
}

void DeflectionHistogram::growToHold(double largest)
{
  int exponent = noRange;
  if (largest > 0)
  {
    std::frexp(largest, &exponent); // largest < 2^exponent
  }
  const std::int64_t bins = finest();
  if (counts_.empty())
  {
    counts_.resize(static_cast<std::size_t>(bins * bins));
  }
  if (exponent_ == noRange)
  {
    exponent_ = exponent; // zeros are where they were
  }
  for (; exponent_ < exponent; ++exponent_)
  {
    std::vector<std::int64_t> merged(counts_.size());
    for (std::int64_t row = 0; row < bins; ++row)
    {
      for (std::int64_t column = 0; column < bins; ++column)
      {
        const std::int64_t to = (row + bins / 2) / 2 * bins + (column + bins / 2) / 2;
        merged[static_cast<std::size_t>(to)] +=
          counts_[static_cast<std::size_t>(row * bins + column)];
      }
    }
    counts_ = std::move(merged);
  }
}

DeflectionBins DeflectionHistogram::bins() const
{
  return { finest(), exponent_ == noRange ? 0 : exponent_ };
}

Histogram DeflectionHistogram::histogram() const
{
  Histogram histogram;
  histogram.size = size_;
  histogram.range = std::ldexp(1., exponent_ == noRange ? exponentAtRest : exponent_);
  histogram.rays.resize(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_));
  const std::int64_t bins = finest();
  for (std::size_t n = 0; n < counts_.size(); ++n)
  {
    const std::int64_t row = static_cast<std::int64_t>(n) / bins * size_ / bins;
    const std::int64_t column = static_cast<std::int64_t>(n) % bins * size_ / bins;
    histogram.rays[static_cast<std::size_t>(row * size_ + column)] += counts_[n];
  }
  return histogram;
}

} // namespace schlieren
