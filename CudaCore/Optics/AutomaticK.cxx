// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/AutomaticK.h"

#include "Optics/Spread.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

double strongDeflection(
  const TracedRays& rays, int width, int height, double noiseFloor, int threads)
{
  const Spread squares = spreadOf(rays, width, height, threads,
    [&rays](std::int64_t ray)
    {
      const double* eps = rays.exits[ray].deflection;
      return eps[0] * eps[0] + eps[1] * eps[1];
    });
  double typical = std::sqrt(squares.percentile);
  if (!(typical > noiseFloor))
  {
    // Light is bent in less than a hundredth of the picture, if at all.
    typical = std::sqrt(squares.largest);
  }
  return squares.rays > 0 ? std::max(typical, noiseFloor) : 0;
}

} // namespace schlieren
