// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/Tint.h"

#include "Optics/Spread.h"

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

double tintReference(const TracedRays& rays, std::size_t fields, int width, int height, int threads)
{
  const Spread sums = spreadOf(rays, width, height, threads,
    [&](std::int64_t ray)
    {
      const float* first = rays.gathered + static_cast<std::size_t>(ray) * fields;
      return std::accumulate(first, first + fields, 0.);
    });
  return sums.percentile > 0 ? sums.percentile : sums.largest;
}

} // namespace schlieren
