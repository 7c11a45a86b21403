// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Samples/FieldGradients.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

void gradientMagnitudes(const Grid& grid, const float* values, const unsigned char* valid,
  int threads, int count, int field, float* gradients)
{
  const std::array<std::int64_t, 3>& n = grid.dimensions;
  const std::int64_t strides[3] = { 1, n[0], n[0] * n[1] };
  const double unit = std::min({ grid.spacing[0], grid.spacing[1], grid.spacing[2] });
  const auto isKnown = [values, valid](std::int64_t at)
  { return (valid == nullptr || valid[at] != 0) && std::isfinite(values[at]); };

  parallelFor(n[1] * n[2], 16, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t row = begin; row < end; ++row)
      {
        for (std::int64_t i = 0; i < n[0]; ++i)
        {
          const std::int64_t at = row * n[0] + i;
          const std::int64_t index[3] = { i, row % n[1], row / n[1] };
          double square = 0;
          for (std::size_t axis = 0; axis < 3 && isKnown(at); ++axis)
          {
            const std::int64_t below = at - strides[axis], above = at + strides[axis];
            const bool hasBelow = index[axis] > 0 && isKnown(below);
            const bool hasAbove = index[axis] < n[axis] - 1 && isKnown(above);
            const double rise = static_cast<double>(values[hasAbove ? above : at]) -
              static_cast<double>(values[hasBelow ? below : at]);
            const double run = (hasAbove ? 1 : 0) + (hasBelow ? 1 : 0);
            const double slope = run > 0 ? rise / run * (unit / grid.spacing[axis]) : 0;
            square += slope * slope;
          }
          gradients[at * count + field] = static_cast<float>(std::sqrt(square));
        }
      }
    });
}

} // namespace schlieren
