// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/CudaPass.h"
#include "Rays/DeflectionBins.h"
#include "Rays/TracedRays.h"
#include "Types.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// Counts the rays of an image by their deflection, pass by pass. Its range is the smallest power of two
/// above all components: so bins merge two by two where it has to grow, and the counts are the same
/// however passes come.
class DeflectionHistogram
{
public:
  /// `size`: bins along u and along v, 1 or more.
  explicit DeflectionHistogram(int size)
    : size_(size)
  {
  }

  int size() const { return size_; }
  int passes() const { return passes_; } ///< that have been added

  /// Adds the rays of a pass that start in the image and reach the film.
  void add(const TracedRays& rays, int width, int height, int threads);
  /// The same of rays on the device, where they are counted. Throws DeviceError.
  void add(const CudaPass& rays, const Pass& pass, int width, int height);

  /// Where nothing bends, the range is 2^-20, 0.2 seconds of arc.
  Histogram histogram() const;

private:
  /// Makes the range large enough for a component of deflection.
  void growToHold(double largest);
  DeflectionBins bins() const;

  /// Bins that are counted: halves where `size_` is odd, because only even numbers can merge.
  std::int64_t finest() const { return size_ % 2 == 0 ? size_ : 2 * std::int64_t{ size_ }; }

  static constexpr int noRange = -10000; ///< nothing bends

  int size_;
  int passes_ = 0;
  int exponent_ = noRange;           ///< they cover -2^exponent_ ... 2^exponent_
  std::vector<std::int64_t> counts_; ///< empty until there is light
};

} // namespace schlieren
