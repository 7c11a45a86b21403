// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Tree/BrickSamples.h"

#include "Medium/Samples/Solids.h"

#include <numeric>

namespace schlieren
{

namespace
{

/// Numbers that are looked at side by side, so that the compiler does so, too.
constexpr std::size_t lanes = 8;

struct Range
{
  double lowest, highest;
};

/// Finds the range of all values; it is not finite where one of them is not.
Range rangeOf(const std::vector<double>& values)
{
  std::array<double, lanes> lowest{}, highest{}, defects{};
  lowest.fill(values.front());
  highest.fill(values.front());
  const auto look = [&](std::size_t lane, double value)
  {
    lowest[lane] = value < lowest[lane] ? value : lowest[lane];
    highest[lane] = value > highest[lane] ? value : highest[lane];
    defects[lane] += value - value; // NaN where it is not finite
  };
  std::size_t n = 0;
  for (; n + lanes <= values.size(); n += lanes)
  {
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      look(lane, values[n + lane]);
    }
  }
  for (; n < values.size(); ++n)
  {
    look(0, values[n]);
  }
  const double defect = std::accumulate(defects.begin(), defects.end(), 0.);
  return { *std::min_element(lowest.begin(), lowest.end()) + defect,
    *std::max_element(highest.begin(), highest.end()) + defect };
}

} // namespace

void BrickSamples::fill()
{
  findGas();
  continueGas();
}

void BrickSamples::findGas()
{
  // As a rule there is nothing else.
  bool areAllGas = isAllWithin() &&
    std::all_of(places.begin(), places.end(), [](Place place) { return place == Place::Gas; });
  if (areAllGas)
  {
    const Range range = rangeOf(nu);
    areAllGas = std::isfinite(range.lowest) && std::isfinite(range.highest);
    if (areAllGas)
    {
      lowest = range.lowest;
      highest = range.highest;
      return;
    }
  }
  isGas.assign(nu.size(), 0);
  double low = lowest, high = highest;
  for (int k = begin[2]; k < end[2]; ++k)
  {
    for (int j = begin[1]; j < end[1]; ++j)
    {
      const std::size_t row = index(0, j, k);
      for (std::size_t at = row + static_cast<std::size_t>(begin[0]);
           at < row + static_cast<std::size_t>(end[0]); ++at)
      {
        const double value = nu[at];
        const bool is = places[at] == Place::Gas && value - value == 0; // finite
        isGas[at] = is ? 1 : 0;
        low = is && value < low ? value : low;
        high = is && value > high ? value : high;
      }
    }
  }
  lowest = low;
  highest = high;
}

void BrickSamples::continueGas()
{
  if (isGas.empty() || !hasGas())
  {
    return;
  }
  bool hasHoles = false;
  for (int k = begin[2]; k < end[2]; ++k)
  {
    for (int j = begin[1]; j < end[1]; ++j)
    {
      for (int i = begin[0]; i < end[0]; ++i)
      {
        hasHoles = hasHoles || isGas[index(i, j, k)] == 0;
      }
    }
  }
  if (hasHoles)
  {
    continueValues(nu, n, layers, isGas);
  }
  // Axis by axis; the later axes carry what the earlier ones have made along.
  std::array<int, 3> from = begin;
  std::array<int, 3> to = end;
  const std::array<int, 3> strides{ 1, n, n * n };
  const std::array<int, 3> points{ n, n, layers };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t a = (axis + 1) % 3;
    const std::size_t b = (axis + 2) % 3;
    for (int p = from[a]; p < to[a]; ++p)
    {
      for (int q = from[b]; q < to[b]; ++q)
      {
        double* line = nu.data() + p * strides[a] + q * strides[b];
        const int stride = strides[axis];
        const auto at = [&](int i) -> double& { return line[i * stride]; };
        for (int i = begin[axis] - 1; i >= 0; --i)
        {
          at(i) = 3 * (at(i + 1) - at(i + 2)) + at(i + 3);
        }
        for (int i = end[axis]; i < points[axis]; ++i)
        {
          at(i) = 3 * (at(i - 1) - at(i - 2)) + at(i - 3);
        }
      }
    }
    from[axis] = 0;
    to[axis] = points[axis];
  }
}

} // namespace schlieren
