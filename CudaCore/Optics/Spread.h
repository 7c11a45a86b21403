// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/Parallel.h"
#include "Rays/DeflectionBins.h"
#include "Rays/TracedRays.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// Exact, of numbers of 0 or more that are counted by their LeadingBits. numbersIn(bin, their count) gives those of a
/// bin, in any order.
template <class NumbersIn>
Spread spreadOf(const std::vector<std::int64_t>& counts, double largest, const NumbersIn& numbersIn)
{
  constexpr double fraction = 0.99;
  Spread spread;
  spread.largest = largest;
  spread.rays = std::accumulate(counts.begin(), counts.end(), std::int64_t{ 0 });
  if (spread.rays == 0)
  {
    return spread;
  }
  auto rank = static_cast<std::int64_t>(fraction * static_cast<double>(spread.rays - 1));
  std::size_t bin = 0;
  while (rank >= counts[bin])
  {
    rank -= counts[bin++];
  }
  std::vector<double> alike = numbersIn(bin, counts[bin]);
  std::nth_element(alike.begin(), alike.begin() + rank, alike.end());
  spread.percentile = alike[static_cast<std::size_t>(rank)];
  return spread;
}

/// The spread of valueOf(ray), numbers of 0 or more, over the pixels of an image. In two passes: the first counts
/// values by their leading bits; the second looks among the few in the percentile's bin.
template <class ValueOf>
Spread spreadOf(const TracedRays& rays, std::int64_t width, std::int64_t height, int threads,
  const ValueOf& valueOf)
{
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

  double largest = 0;
  std::vector<std::int64_t> counts(LeadingBits::count);
  forEachPiece(
    [&](const auto& forEachValue)
    {
      std::vector<std::int64_t> countsHere(counts.size());
      double largestHere = 0;
      forEachValue(
        [&](double value)
        {
          ++countsHere[LeadingBits::of(value)];
          largestHere = std::max(largestHere, value);
        });
      const std::lock_guard<std::mutex> guard(lock);
      std::transform(
        counts.begin(), counts.end(), countsHere.begin(), counts.begin(), std::plus<>());
      largest = std::max(largest, largestHere);
    });
  return spreadOf(counts, largest,
    [&](std::size_t bin, std::int64_t count)
    {
      std::vector<double> alike;
      alike.reserve(static_cast<std::size_t>(count));
      forEachPiece(
        [&](const auto& forEachValue)
        {
          std::vector<double> alikeHere;
          forEachValue(
            [&](double value)
            {
              if (LeadingBits::of(value) == bin)
              {
                alikeHere.push_back(value);
              }
            });
          const std::lock_guard<std::mutex> guard(lock);
          alike.insert(alike.end(), alikeHere.begin(), alikeHere.end());
        });
      return alike;
    });
}

} // namespace schlieren
