// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Optics/RayAtFilm.h"
#include "Rays/RayExit.h"

#include <cmath>

namespace schlieren
{

/// From the grid's exit plane to the film.
struct Projection
{
  double distance;    ///< of what the film shows past the exit plane, data units; < 0: before it
  double perDataUnit; ///< pixels
  double pathPerDataUnit; ///< optical path of undisturbed light, metres
};

/// A ray that starts at (column, row) of the picture and reaches the film, there. The camera's lens makes all
/// paths from a point in focus to its picture equal, so that the path on the film is that to this point.
SCHLIEREN_HD RayAtFilm rayAtFilm(
  const RayExit& exit, double column, double row, const Projection& projection)
{
  const double* eps = exit.deflection;
  const double sideways = eps[0] * eps[0] + eps[1] * eps[1];
  const double forward = sqrt(sideways < 1 ? 1 - sideways : 1e-30); // cosine along w
  const double way = projection.distance / forward;
  // 1 / forward - 1, without losing small angles.
  const double longer = sideways / (forward * (1 + forward));
  return { { eps[0], eps[1] },
    exit.opticalPathDifference + projection.distance * longer * projection.pathPerDataUnit,
    { column + (static_cast<double>(exit.displacement[0]) + way * eps[0]) * projection.perDataUnit,
      row + (static_cast<double>(exit.displacement[1]) + way * eps[1]) * projection.perDataUnit } };
}

} // namespace schlieren
