// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/UninitialisedAllocator.h"
#include "Types.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// Samples, not initialised, on a grid of `dimensions` points with one layer of ghost points on each side.
template <class Real>
struct PaddedVolume
{
  explicit PaddedVolume(const std::array<std::int64_t, 3>& gridDimensions)
    : dimensions(gridDimensions)
    , strides{ 1, gridDimensions[0] + 2, (gridDimensions[0] + 2) * (gridDimensions[1] + 2) }
    , samples(static_cast<std::size_t>(strides[2] * (gridDimensions[2] + 2) + readTogether))
  {
    std::fill(samples.end() - readTogether, samples.end(), Real(0));
  }

  std::int64_t index(std::int64_t i, std::int64_t j, std::int64_t k) const
  {
    return (i + 1) + (j + 1) * strides[1] + (k + 1) * strides[2];
  }

  Real& at(std::int64_t i, std::int64_t j, std::int64_t k)
  {
    return samples[static_cast<std::size_t>(index(i, j, k))];
  }

  /// Packs of rays load so many samples of a row at once, also where the scheme weighs fewer: beyond the
  /// last row there must be something to load.
  static constexpr std::int64_t readTogether = 4;

  std::array<std::int64_t, 3> dimensions;
  std::array<std::int64_t, 3> strides;
  /// x fastest; behind the last one `readTogether` zeros.
  std::vector<Real, UninitialisedAllocator<Real>> samples;
};

/// Replaces samples by the coefficients of the quadratic B-spline through them (Unser, Aldroubi &
/// Eden 1993, "B-spline signal processing", eq. 2.3 for n = 2: s_i = (c_{i-1} + 6 c_i + c_{i+1}) / 8),
/// solved exactly line by line. At both ends the coefficients continue as a parabola through the last
/// three, which keeps the order of the interpolation (a mirror would force the gradient to 0 there).
template <class Real>
void prefilterQuadratic(PaddedVolume<Real>& volume, int threads);

/// The same for the cubic one: s_i = (c_{i-1} + 4 c_i + c_{i+1}) / 6, going on as a cubic through the last
/// four (a parabola where there are but three).
template <class Real>
void prefilterCubic(PaddedVolume<Real>& volume, int threads);

/// Fills the ghost layer by polynomials of `degree`, 1 to 3, through as many of the last samples as that
/// takes (of lower degree where there are fewer). After a prefilter: of the spline's degree.
template <class Real>
void fillGhosts(PaddedVolume<Real>& volume, int degree);

} // namespace schlieren
