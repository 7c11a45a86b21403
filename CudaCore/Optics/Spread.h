// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/Parallel.h"
#include "Rays/TracedRays.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <mutex>
#include <numeric>
#include <vector>

namespace schlieren
{

/// How large a number is that belongs to each ray.
struct Spread
{
  std::int64_t rays = 0; ///< that crossed the medium and reached the film
  double percentile = 0; ///< what 99 % of them do not exceed
  double largest = 0;
};

/// The spread of valueOf(ray), numbers of 0 or more, over the pixels of a picture. Exact, in two passes:
/// the first counts values by their leading bits, which grow with them; the second looks among the few
/// that share theirs with the percentile.
template <class ValueOf>
Spread spreadOf(const TracedRays& rays, std::int64_t width, std::int64_t height, int threads,
  const ValueOf& valueOf)
{
  constexpr double share = 0.99;
  constexpr int leadingBits = 16; // sign, exponent and 4 bits of the fraction
  const auto leading = [](double value)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    return static_cast<std::size_t>(bits >> (64 - leadingBits));
  };
  std::mutex lock;
  const auto forEachPiece = [&](const auto& work)
  {
    parallelFor(height, (height - 1) / threadCount(threads) + 1, threads,
      [&](std::int64_t begin, std::int64_t end)
      {
        work(
          [&](const auto& use)
          {
            for (std::int64_t row = begin; row < end; ++row)
            {
              const std::int64_t first = rays.rayOf(0, row);
              for (std::int64_t ray = first; ray < first + width; ++ray)
              {
                if (rays.exits[ray].fate == RayFate::Left)
                {
                  use(valueOf(ray));
                }
              }
            }
          });
      });
  };

  Spread spread;
  std::vector<std::int64_t> counts(std::size_t{ 1 } << leadingBits);
  forEachPiece(
    [&](const auto& forEachValue)
    {
      std::vector<std::int64_t> countsHere(counts.size());
      double largest = 0;
      forEachValue(
        [&](double value)
        {
          ++countsHere[leading(value)];
          largest = std::max(largest, value);
        });
      const std::lock_guard<std::mutex> guard(lock);
      std::transform(
        counts.begin(), counts.end(), countsHere.begin(), counts.begin(), std::plus<>());
      spread.largest = std::max(spread.largest, largest);
    });
  spread.rays = std::accumulate(counts.begin(), counts.end(), std::int64_t{ 0 });
  if (spread.rays == 0)
  {
    return spread;
  }

  auto rank = static_cast<std::int64_t>(share * static_cast<double>(spread.rays - 1));
  std::size_t bin = 0;
  while (rank >= counts[bin])
  {
    rank -= counts[bin++];
  }
  std::vector<double> alike;
  alike.reserve(static_cast<std::size_t>(counts[bin]));
  forEachPiece(
    [&](const auto& forEachValue)
    {
      std::vector<double> alikeHere;
      forEachValue(
        [&](double value)
        {
          if (leading(value) == bin)
          {
            alikeHere.push_back(value);
          }
        });
      const std::lock_guard<std::mutex> guard(lock);
      alike.insert(alike.end(), alikeHere.begin(), alikeHere.end());
    });
  std::nth_element(alike.begin(), alike.begin() + rank, alike.end());
  spread.percentile = alike[static_cast<std::size_t>(rank)];
  return spread;
}

} // namespace schlieren
