// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/UninitialisedAllocator.h"
#include "Math/HostDevice.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

enum class RayFate : std::int32_t
{
  Missed,  ///< never met the grid: undisturbed
  Left,    ///< crossed the grid
  Blocked, ///< ended in a solid
  Trapped, ///< met the step limit inside the grid
  Turned   ///< left the grid going back, away from the film, or is totally reflected there
};

/// The planes across w through which light enters and leaves the data.
///
/// Where they refract it, what p has along them is the same on both sides (Snell). With p in units of n_ref and d the
/// undisturbed light's direction in the data, the direction cosines outside are `ratio` times p.u and p.v, those of
/// undisturbed light `ratio` times d.u and d.v.
struct ExitFaces
{
  bool refract; ///< else light keeps the direction that it has in the data
  double
    ratio; ///< n_ref by the index of what light leaves the data into; 1 where they do not refract
};
constexpr ExitFaces noFaces{ false, 1 };

/// What a traced ray hands on; the only thing that optics and film see.
struct RayExit
{
  double deflection[2];  ///< direction cosines along u and v, less those of undisturbed light
  float displacement[2]; ///< on the exit plane, along u and v, data units
  double opticalPathDifference; ///< metres, on the exit plane
  RayFate fate;
  std::int32_t steps;

  SCHLIEREN_HD bool reachesFilm() const { return fate == RayFate::Missed || fate == RayFate::Left; }
};

using RayExits = std::vector<RayExit, UninitialisedAllocator<RayExit>>;

/// Where in its pixel a ray starts, relative to the centre, in pixels.
struct PixelOffset
{
  double column, row;
};

/// One ray for each of a rectangle of pixels (the image and a margin around it), row by row.
struct Pass
{
  std::int64_t firstColumn, firstRow;
  std::int64_t columns, rows;
  PixelOffset offset;        ///< the same in all pixels
  double tilt[2] = { 0, 0 }; ///< of the light of one point of the source: slopes along u and v
  /// Pixels: each ray has the light of a square of this side, see sideOf().
  double side = 1;

  /// Where a ray starts, in pixels from the centre of pixel (0, 0).
  SCHLIEREN_HD double columnOf(std::int64_t ray) const
  {
    const std::int64_t column = firstColumn + ray % columns;
    return static_cast<double>(column) + offset.column;
  }
  SCHLIEREN_HD double rowOf(std::int64_t ray) const
  {
    const std::int64_t row = firstRow + ray / columns;
    return static_cast<double>(row) + offset.row;
  }
};

} // namespace schlieren
