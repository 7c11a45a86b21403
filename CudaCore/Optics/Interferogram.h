// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two beams of equal light, one through the medium and one past it (Merzkirch 1987, ch. 3). A camera sees the
// mean square of their sum, I = (1 + cos phi) / 2, phi = 2 pi OPD / wavelength + carrier. Brownlee et al.
// 2011, eq. 16, take sin(2 pi OPD / wavelength): as many fringes, a quarter of one further on, but half of
// each is negative, which is no intensity.
#pragma once

#include "Math/HostDevice.h"
#include "Math/Trigonometry.h"
#include "Math/Units.h"
#include "Optics/Color.h"
#include "Optics/RayAtFilm.h"

#include <array>
#include <cmath>

namespace schlieren
{

/// The phase, in turns, that a tilted reference beam adds: it grows across the film from 0 in its middle.
struct Carrier
{
  double perColumn = 0, perRow = 0; ///< of a pixel
  double atOrigin = 0;              ///< at the centre of pixel (0, 0)

  /// Fringes `spacing` pixels apart, and more of them in the direction of `degrees` from u to v, counted from `zero`.
  static Carrier of(double spacing, double degrees, const std::array<double, 2>& zero)
  {
    const double turn = std::remainder(degrees, 360.0);
    const double column = std::abs(turn) == 90 ? 0 : std::cos(turn * radiansPerDegree) / spacing;
    const double row = std::abs(turn) == 180 ? 0 : std::sin(turn * radiansPerDegree) / spacing;
    return { column, row, -(column * zero[0] + row * zero[1]) };
  }

  bool isNone() const { return perColumn == 0 && perRow == 0; }

  SCHLIEREN_HD double turnsAt(const double (&position)[2]) const
  {
    return perColumn * position[0] + perRow * position[1] + atOrigin;
  }
};

/// The light of two beams of one wavelength, (1 + cos(2 pi turns)) / 2, or its mean over a parallelogram in whose middle they
/// differ by `turns`, and by so many more from one side to the other.
SCHLIEREN_HD double fringeLight(double turns, double along = 0, double up = 0)
{
  const double sine = sinPi(fromNearestWhole(turns));
  const double contrast = along == 0 && up == 0 ? 1 : sincPi(along) * sincPi(up);
  return limited(0.5 + contrast * (0.5 - sine * sine));
}

/// Makes fringes in light of one wavelength.
struct Interferogram
{
  static constexpr int channels = 1;

  double perWavelength; ///< 1 / metres
  Carrier carrier;      ///< none where fringes are infinite

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    // Apart: 1e7 wavelengths leave a double 1e-9 of a fringe.
    const double ofPath = fromNearestWhole(ray.path * perWavelength);
    light[0] = fringeLight(ofPath + carrier.turnsAt(ray.position));
  }
  SCHLIEREN_HD bool saturates(const double (&)[2]) const { return false; }
};

/// Gives rays their phase in turns instead of their light, for whoever interpolates between rays: light has fringes, which
/// interpolation flattens, and the phase has none.
struct FringePhase
{
  static constexpr int channels = 1;

  Interferogram fringes;

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&turns)[channels]) const
  {
    turns[0] = ray.path * fringes.perWavelength + fringes.carrier.turnsAt(ray.position);
  }
  SCHLIEREN_HD bool saturates(const double (&)[2]) const { return false; }
};

} // namespace schlieren
