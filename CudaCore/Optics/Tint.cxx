// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/Tint.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace schlieren
{

std::array<double, 3> Tint::of(const float* gathered) const
{
  double sum = 0;
  std::array<double, 3> color{ 0, 0, 0 };
  for (std::size_t field = 0; field < colors.size(); ++field)
  {
    const double weight = static_cast<double>(gathered[field]);
    sum += weight;
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      color[channel] += weight * static_cast<double>(colors[field][channel]);
    }
  }
  const double strength = reference > 0 ? std::min(1., sum / reference) : 0;
  for (double& channel : color)
  {
    channel = strength > 0 ? 1 + strength * (channel / sum - 1) : 1;
  }
  return color;
}

double tintReference(const RayExit* exits, const float* gathered, std::size_t fields,
  const Pass& pass, int width, int height)
{
  constexpr double percentile = 0.99;
  std::vector<double> sums;
  for (std::int64_t row = 0; row < height; ++row)
  {
    for (std::int64_t column = 0; column < width; ++column)
    {
      const std::int64_t ray = (row - pass.firstRow) * pass.columns + column - pass.firstColumn;
      if (exits[ray].fate == RayFate::Left)
      {
        const float* first = gathered + static_cast<std::size_t>(ray) * fields;
        sums.push_back(std::accumulate(first, first + fields, 0.));
      }
    }
  }
  if (sums.empty())
  {
    return 0;
  }
  const auto at =
    sums.begin() + static_cast<std::ptrdiff_t>(percentile * static_cast<double>(sums.size() - 1));
  std::nth_element(sums.begin(), at, sums.end());
  return *at > 0 ? *at : *std::max_element(at, sums.end());
}

} // namespace schlieren
