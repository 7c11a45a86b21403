// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/AutomaticK.h"

#include "Optics/Spread.h"

#include <algorithm>
#include <cmath>

namespace schlieren
{

namespace
{

double strongDeflection(const Spread& squares, const DeflectionErrors& errors)
{
  constexpr double errorByFullScale = 0.02, fullScaleByLargest = 0.1;
  const double largest = std::sqrt(squares.largest);
  double typical = std::sqrt(squares.percentile);
  if (!(typical > errors.rounding))
  {
    // Light is bent in less than a hundredth of the image, if at all.
    typical = largest;
  }
  typical =
    std::max(typical, std::min(errors.medium / errorByFullScale, fullScaleByLargest * largest));
  return squares.rays > 0 ? std::max(typical, errors.rounding) : 0;
}

} // namespace

double strongDeflection(
  const TracedRays& rays, int width, int height, const DeflectionErrors& errors, int threads)
{
  return strongDeflection(
    spreadOf(rays, width, height, threads,
      [&rays](std::int64_t ray) { return squaredDeflection(rays.exits[ray]); }),
    errors);
}

double strongDeflection(
  const CudaPass& rays, const Pass& pass, int width, int height, const DeflectionErrors& errors)
{
  const CudaPass::Squares squares = rays.countSquares(pass, width, height);
  return strongDeflection(spreadOf(squares.counts, squares.largest,
                            [&](std::size_t bin, std::int64_t count)
                            { return rays.squaresIn(bin, count, pass, width, height); }),
    errors);
}

} // namespace schlieren
