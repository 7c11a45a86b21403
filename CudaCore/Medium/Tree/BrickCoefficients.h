// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Tree/BrickSamples.h"

namespace schlieren
{

/// Samples on both sides of a coefficient's place that decide whether there is a front.
inline constexpr int supportOfFronts = 2;

/// How samples become the coefficients of a B-spline: by c = N - outer d2, d2 being second differences along each axis
/// (a quasi-interpolant of third order: de Boor & Fix 1973), limited at fronts (Documentation/development/theory.md).
struct CoefficientRule
{
  double outer;     ///< 1/8 of quadratic splines, 1/6 of cubic ones
  int apron;        ///< layers around a brick whose coefficients are wanted
  std::size_t axes; ///< with more than one sample
  double overshoot; ///< nu: what is beyond the samples around by no more than this is not limited
};

/// Makes coefficients of samples. False: a front is at the brick's side, where supportOfFronts samples beyond the apron
/// are needed; the samples are of no use any more.
bool makeCoefficients(BrickSamples& samples, const CoefficientRule& rule);

} // namespace schlieren
