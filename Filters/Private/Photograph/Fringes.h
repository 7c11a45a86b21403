// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The fringes of a reference beam, and where a photograph shows them.
#pragma once

#include "Photograph/Plane.h"

#include <array>

namespace filters
{

/// Light in proportion to 1 + contrast cos(phase + tilt[0] x + tilt[1] y) where the path is undisturbed; x and y are -1 to 1 from the
/// first to the last point along columns and rows.
struct Fringes
{
  double contrast = 1;
  double phase = 0;             ///< radians, at the middle
  std::array<double, 2> tilt{}; ///< radians

  double phaseAt(double x, double y) const { return phase + tilt[0] * x + tilt[1] * y; }
};

/// Returns the coordinate, from -1 to 1, of the place `index` among so many points.
inline double coordinate(double index, int count)
{
  return count > 1 ? 2 * index / (count - 1) - 1 : 0;
}

/**
 * Finds fringes contrast cos(phase + tilt + path) by the Fourier transform of light times exp(-i path): at the right tilt, those that
 * the flow has shifted add up as well (a matched filter; after Takeda, Ina and Kobayashi 1982). Returns the strongest ones, then those
 * with the opposite tilt. Tilts are half a fringe over the image apart, and fringes at least four blocks wide, of which the longer side
 * has at most 200.
 *
 * `light`: of the photograph. `weight`: 1 where it is known, else 0. `turns`: the path through the flow, wavelengths; may be without
 * whole ones. `withoutFlow`: light without flow, or empty; the strength of its fringes counts as well.
 */
std::array<Fringes, 2> findFringes(
  const Plane& light, const Plane& weight, const Plane& turns, const Plane& withoutFlow);

} // namespace filters
