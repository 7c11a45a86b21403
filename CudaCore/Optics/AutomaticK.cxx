// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/AutomaticK.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace schlieren
{

double automaticK(const RayExit* exits, const Pass& pass, int width, int height, double noiseFloor)
{
  constexpr double percentile = 0.99;
  constexpr double fullScale = 0.5;
  std::vector<double> sizes;
  for (std::int64_t row = 0; row < height; ++row)
  {
    for (std::int64_t column = 0; column < width; ++column)
    {
      const RayExit& exit = exits[(row - pass.firstRow) * pass.columns + column - pass.firstColumn];
      if (exit.fate == RayFate::Left)
      {
        sizes.push_back(std::hypot(exit.deflection[0], exit.deflection[1]));
      }
    }
  }
  if (sizes.empty())
  {
    return 1;
  }
  const auto at =
    sizes.begin() + static_cast<std::ptrdiff_t>(percentile * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  double typical = *at;
  if (!(typical > noiseFloor))
  {
    // Light is bent in less than a hundredth of the picture, if at all.
    typical = *std::max_element(at, sizes.end());
  }
  const double signal = std::max(typical, noiseFloor);
  return signal > 0 ? fullScale / signal : 1;
}

} // namespace schlieren
