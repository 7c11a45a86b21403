// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Rays/RayExit.h"

#include <cmath>

namespace schlieren
{

/// From the grid's exit plane to the film.
struct Projection
{
  double distance;    ///< of what the film shows past the exit plane, data units; < 0: before it
  double perDataUnit; ///< pixels
};

/// Where light meets the film, in pixels from the centre of pixel (0, 0).
struct Landing
{
  double column, row;
};

/// Of a ray that starts at (column, row) of the picture and reaches the film.
SCHLIEREN_HD Landing landingOf(
  const RayExit& exit, double column, double row, const Projection& projection)
{
  const double* eps = exit.deflection;
  const double forward = 1 - eps[0] * eps[0] - eps[1] * eps[1]; // squared cosine along w
  const double perCosine = projection.distance / sqrt(forward > 1e-300 ? forward : 1e-300);
  return { column +
      (static_cast<double>(exit.displacement[0]) + perCosine * eps[0]) * projection.perDataUnit,
    row +
      (static_cast<double>(exit.displacement[1]) + perCosine * eps[1]) * projection.perDataUnit };
}

} // namespace schlieren
