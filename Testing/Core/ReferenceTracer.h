// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What images should be: Documentation/theory.md as directly as it can be written. It shares nothing with the tracer but the
// description of what is wanted (Scene, Grid), is exact to about 1e-12 of the refractivity, and slow: some thousand rays a second.
#pragma once

#include "Schlieren.h"

#include <array>
#include <complex>
#include <functional>
#include <vector>

namespace schlieren::reference
{

using Real = long double;
using Vec = std::array<Real, 3>; ///< in data coordinates, or index coordinates
using Color = std::array<Real, 3>;
using Pair = std::complex<Real>; ///< along the image's u and v

template <std::size_t n>
std::array<Real, n> operator*(Real s, std::array<Real, n> a)
{
  for (Real& component : a)
  {
    component *= s;
  }
  return a;
}
template <std::size_t n>
std::array<Real, n> operator+(std::array<Real, n> a, const std::array<Real, n>& b)
{
  for (std::size_t i = 0; i < n; ++i)
  {
    a[i] += b[i];
  }
  return a;
}
template <std::size_t n>
std::array<Real, n> operator-(const std::array<Real, n>& a, const std::array<Real, n>& b)
{
  return a + Real(-1) * b;
}

/// Refractivity at a place in data coordinates, and its gradient by data units.
struct Value
{
  Real refractivity = 0;
  Vec gradient{};
};
using Refractivity = std::function<Value(const Vec&)>;

/// A box between planes of the grid, in index coordinates, and the smooth function that the refractivity is in it. The
/// function continues as smoothly outside, so that no step towards a side of the box meets a kink.
struct Piece
{
  Vec low, high;
  Refractivity valueAt;
};

/// Refractivity in the box of a grid.
struct Flow
{
  Grid grid;
  std::function<Piece(const Vec& index)>
    pieceAt;            ///< the piece that has a place in index coordinates
  Real largest = 1;     ///< of |N - ambient|, about: errors are relative to it
  Real ambient = 0;     ///< N outside
  Real lengthScale = 1; ///< metres per data unit
};

/// A flow that is one formula, smooth in all of the box.
Flow flowOf(const Grid& grid, const Refractivity& refractivity, Real largest);

/// The spline (Linear, Quadratic, Cubic) through samples at the grid's points, x fastest. At the grid's sides its coefficients
/// continue as the polynomial of the spline's degree through the last of them.
Flow splineThrough(
  const Grid& grid, const std::vector<double>& samples, Interpolation interpolation, Real largest);

/// Of a ray: where it is, n times its direction, and the integral of n ds so far (data units).
struct RayState
{
  Vec position, momentum;
  Real path = 0;
};

/// Follows d/ds (n dr/ds) = grad n from a place in the box to where the ray leaves it.
RayState follow(const Flow& flow, const RayState& start);

/// As those of schlieren::Image. Intensity of FilmEstimator::Sheet is the mean over a pixel's area of a film that has no folds.
struct Images
{
  std::vector<Pair> deflection, displacement,
    shift; ///< of Cutoff::Background shift is backgroundDisplacement
  std::vector<Real> opticalPathDifference, intensity, background;
  std::vector<Color> color;
};

/// Makes what is of rays through pixels' centres, for a scene with parallelScale and ExitInto::Surroundings. Rays bend, whatever
/// its path model. There are no bodies.
Images trace(const Flow& flow, const Scene& scene);

/// Makes all images, for a scene that also has kScale where its cutoff has a k, and seed 1. There are no fields that tint, and no
/// noise filters.
Images render(const Flow& flow, const Scene& scene);

} // namespace schlieren::reference
