// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/AutomaticK.h"

#include "Optics/Spread.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

double strongDeflection(
  const TracedRays& rays, int width, int height, const DeflectionErrors& errors, int threads)
{
  constexpr double errorByFullScale = 0.02, fullScaleByLargest = 0.1;
  const Spread squares = spreadOf(rays, width, height, threads,
    [&rays](std::int64_t ray)
    {
      const double* eps = rays.exits[ray].deflection;
      return eps[0] * eps[0] + eps[1] * eps[1];
    });
  const double largest = std::sqrt(squares.largest);
  double typical = std::sqrt(squares.percentile);
  if (!(typical > errors.rounding))
  {
    // Light is bent in less than a hundredth of the picture, if at all.
    typical = largest;
  }
  typical =
    std::max(typical, std::min(errors.medium / errorByFullScale, fullScaleByLargest * largest));
  return squares.rays > 0 ? std::max(typical, errors.rounding) : 0;
}

} // namespace schlieren
