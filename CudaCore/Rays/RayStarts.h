// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the rays of an image's passes start: in their pixels, in an extended source, and in an aperture.
#pragma once

#include "Rays/RayExit.h"
#include "Types.h"

#include <array>
#include <cstdint>

namespace schlieren
{

/// The place of pass `pass` in an extended source, as slopes along u and v seen from the middle of the data.
/// Pass 0 is its centre. Later ones follow the sequence of multiples of the golden ratio and of sqrt(2)
/// (Kronecker), which fills a disc evenly by area. `knifeEdgeAngle`, degrees: across a slit.
std::array<double, 2> sourcePoint(
  const LightSource& source, double knifeEdgeAngle, std::int64_t pass, std::uint32_t seed);

/// The place of pass `pass` of `passes` in an aperture of radius 1. They lie on a spiral that fills it most evenly (Vogel
/// 1979), in an order in which the first ones are all over it. Pass 0 is the centre.
std::array<double, 2> pupilPoint(std::int64_t pass, std::int64_t passes);

/// Where in its pixel the ray of pass `pass` starts, relative to the centre, in [-1/2, 1/2).
/// Pass 0 is the centre. Along both axes the first 4, 8, 16 ... 4096 passes are evenly spaced, so that an edge along a pixel's
/// sides is wrong by one ray at the most. Of 4, 8, 16, 32 and 64 such points these are the ones that cover half-planes of
/// any angle best, about. Each seed mirrors and exchanges the axes, and begins with another of the first four points.
/// The offset is the same in all pixels of a pass: a pass is a lattice, and bilinear splats of an undisturbed
/// lattice add up to an exactly even film, so undisturbed light carries no sampling noise.
///
/// `together`: of 8, 16, 32 ... passes that are exposed together, the points are those of Hammersley (1960), k/n and the digits of
/// k the other way round. They are as evenly spaced along both axes, and near the points of a square grid, so that the squares
/// of light around them (see sideOf) stay even where light is compressed: on a screen their noise is 3 times (16 rays), 6 times (64)
/// and 14 times (256) less than that of the sequence's. The first 4, 16 ... of them are evenly spread. Passes from there on have the points
/// again, all moved alike.
PixelOffset pixelOffset(std::int64_t pass, std::uint32_t seed, std::int64_t together = 1);

/// Whether so many passes together have points of their own: then the first ones of more passes are others.
constexpr bool haveOwnPoints(std::int64_t together)
{
  return together > 4 && (together & (together - 1)) == 0;
}

/// The side, in pixels, of the square whose light each ray has of so many per pixel. Light that changes within a pixel is
/// blurred by that side and no more. Squares of 4, 16 or 64 rays cover each column and row of a pixel evenly, as the rays are
/// evenly spaced.
double sideOf(std::int64_t raysPerPixel);

} // namespace schlieren
