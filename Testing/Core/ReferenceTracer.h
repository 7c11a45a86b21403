// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What images should be: Documentation/theory.md as directly as it can be written. It shares nothing with the tracer but the
// description of what is wanted (Scene, Grid) and the points of a pixel (pixelOffset), is exact to about 1e-12 of the refractivity, and slow: some thousand rays a second.
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

/// Of a grid: from a point to the next one along an axis, and index coordinates of a place.
Vec stepOf(const Grid& grid, std::size_t axis);
Vec indexOf(const Grid& grid, const Vec& place);

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
  std::function<Piece(const Vec&)> pieceAt; ///< that has a place in index coordinates
  Real largest = 1;                         ///< of |N - ambient|, about: errors are relative to it
  Real ambient = 0;                         ///< N outside
  Real lengthScale = 1;                     ///< metres per data unit
};

/// A flow that is one formula, smooth in all of the box.
Flow flowOf(const Grid& grid, const Refractivity& refractivity, Real largest);

/// Of a ray: where it is, n times its direction, and the integral of n ds so far (data units).
struct RayState
{
  Vec position, momentum;
  Real path = 0;
};

/// Follows d/ds (n dr/ds) = grad n from a place in the box to where the ray leaves it.
RayState follow(const Flow& flow, const RayState& start);

/// What a ray through the middle of a pixel has. Places are in data units of the image, from its middle.
struct Ray
{
  Pair deflection, displacement; ///< displacement: where it leaves the data, as opticalPath
  Pair shift, place; ///< on the film, in data units there, and where it lands in the image
  Real opticalPath = 0, onFilm = 0; ///< difference to undisturbed light, metres
  Pair behind;                      ///< where it lands along u and v of the data, data units
  Real magnification = 1;           ///< of the image there
};

/// Traces the rays through the pixels' centres, row by row, for a scene with parallelScale and ExitInto::Surroundings. They
/// bend, whatever its path model. There are no bodies.
std::vector<Ray> trace(const Flow& flow, const Scene& scene);

/// Makes an image (all three the same where there are no colours) of a scene that also has kScale where its cutoff has a k, and
/// seed 1. FilmEstimator::Sheet: the mean over the pixels' areas of a film that has no folds. There are no images as filters or
/// patterns, white light, fields that tint, or noise filters.
std::vector<Color> render(const Flow& flow, const Scene& scene);

} // namespace schlieren::reference
