// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Samples/Prefilter.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// One bit per point of a grid, without ghosts. Every row begins with a word of its own, so that threads
/// may write different rows. What a row's last word has beyond the row is 1.
struct PointMask
{
  explicit PointMask(const std::array<std::int64_t, 3>& gridDimensions)
    : dimensions(gridDimensions)
    , wordsPerRow((gridDimensions[0] + 63) / 64)
    , words(static_cast<std::size_t>(wordsPerRow * gridDimensions[1] * gridDimensions[2]),
        ~std::uint64_t{ 0 })
  {
  }

  std::uint64_t* row(std::int64_t j, std::int64_t k)
  {
    return words.data() + (k * dimensions[1] + j) * wordsPerRow;
  }
  const std::uint64_t* row(std::int64_t j, std::int64_t k) const
  {
    return words.data() + (k * dimensions[1] + j) * wordsPerRow;
  }

  /// Sets those bits of a row's n-th word that stand for points.
  std::uint64_t pointsOf(std::int64_t n) const
  {
    const std::int64_t points = dimensions[0] - 64 * n;
    return points < 64 ? (std::uint64_t{ 1 } << points) - 1 : ~std::uint64_t{ 0 };
  }

  bool any() const
  {
    for (std::size_t n = 0; n < words.size(); ++n)
    {
      const auto inRow = static_cast<std::int64_t>(n) % wordsPerRow;
      if ((words[n] & pointsOf(inRow)) != 0)
      {
        return true;
      }
    }
    return false;
  }

  std::array<std::int64_t, 3> dimensions;
  std::int64_t wordsPerRow;
  std::vector<std::uint64_t> words;
};

/// How values continue where there is no gas.
enum class Continuation
{
  Constant,
  Linear ///< so that gradients are not bent at walls
};

/// Gives the points of `empty` the mean of those neighbours (of 26) that have a value already, layer
/// after layer, outward from the gas. Gas keeps its values; next to a body in uniform gas there is no
/// gradient. Needs two bits of memory a point, `empty` included.
template <class Real>
void fillEmpty(PaddedVolume<Real>& volume, PointMask empty, int threads,
  Continuation continuation = Continuation::Constant);

/// Gives values to the points of a brick, n by n by `layers` of them, of which no value is known: they continue linearly
/// as far as splines in the gas depend on them; farther on they are between those. n is below 64.
void continueValues(
  std::vector<double>& values, int n, int layers, const std::vector<unsigned char>& isKnown);

/// The mask laid out as in MediumView, one bit per sample of `volume`.
template <class Real>
std::vector<std::uint32_t> bitsPerSample(const PaddedVolume<Real>& volume, const PointMask& mask);

} // namespace schlieren
