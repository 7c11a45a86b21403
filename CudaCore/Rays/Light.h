// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/Vec3.h"
#include "Rays/RayExit.h"
#include "Schlieren.h"

#include <cstdint>

namespace schlieren
{

/// Collimated light: for a point of the picture, the straight line in the grid's index coordinates
/// that light follows there before anything bends it. Lengths are in units of the smallest grid
/// spacing, so that nothing depends on the data's unit of length.
struct Light
{
  Vec3<double> corner;    ///< index coordinates of the centre of pixel (0, 0) on the entry plane
  Vec3<double> perColumn; ///< index coordinates per pixel along u
  Vec3<double> perRow;    ///< index coordinates per pixel along v
  Vec3<double> perLength; ///< index coordinates per unit of length along w
  Vec3<double> lengthPer; ///< its inverse, axis by axis; infinite where it is 0

  Vec3<double> u, v, w;       ///< the picture's axes in the grid's axes
  Vec3<double> indexScale;    ///< index coordinates per unit of length along each grid axis
  Vec3<double> unitsPerIndex; ///< its inverse, axis by axis
  double depth;               ///< entry plane to exit plane
  double unit;                ///< the unit of length, data units

  SCHLIEREN_HD Vec3<double> start(double column, double row) const
  {
    return corner + column * perColumn + row * perRow;
  }
};

/// The light of the picture `frame` of `grid`.
Light collimatedLight(const Grid& grid, const Frame& frame);

/// Where in its pixel the ray of pass `pass` starts, relative to the centre, in [-1/2, 1/2).
/// Pass 0 is the centre; later passes follow the two-dimensional golden-ratio sequence R2 (Roberts
/// 2018, "The unreasonable effectiveness of quasirandom sequences"), begun elsewhere for each seed.
/// All pixels of a pass share the offset: a pass is a lattice, and bilinear splats of an undisturbed
/// lattice add up to an exactly even film, so undisturbed light carries no sampling noise.
PixelOffset pixelOffset(std::int64_t pass, std::uint32_t seed);

} // namespace schlieren
