// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Optics/Color.h"
#include "Optics/RayAtFilm.h"

#include <cmath>

namespace schlieren
{

/// How far from the axis a ray meets the cutoff plane: k |eps|.
SCHLIEREN_HD double distanceFromAxis(double k, const double (&eps)[2])
{
  return k * sqrt(eps[0] * eps[0] + eps[1] * eps[1]);
}

/// A stop that lets less light pass the further it is from the axis, whatever its direction (Brownlee et
/// al. 2011, eq. 15): I = 1 - k |eps|, bright field.
struct BrightField
{
  static constexpr int channels = 1;

  double k;

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    light[0] = limited(1 - distanceFromAxis(k, ray.deflection));
  }
  SCHLIEREN_HD bool saturates(const double (&eps)[2]) const { return distanceFromAxis(k, eps) > 1; }
};

/// Its complement, dark field: I = k |eps|.
struct DarkField
{
  static constexpr int channels = 1;

  double k;

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    light[0] = limited(distanceFromAxis(k, ray.deflection));
  }
  SCHLIEREN_HD bool saturates(const double (&eps)[2]) const { return distanceFromAxis(k, eps) > 1; }
};

} // namespace schlieren
