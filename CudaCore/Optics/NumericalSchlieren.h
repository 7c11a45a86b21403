// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Optics/BrightField.h"
#include "Optics/RayAtFilm.h"

namespace schlieren
{

/// exp(-x) for x >= 0, and exp(-40) for more and for what is no number. Of sums and products alone, the same to the last
/// bit on host and device; relative error 1e-9.
SCHLIEREN_HD double exponentialOfMinus(double x)
{
  constexpr double halvings = 1. / 64;
  constexpr int terms = 11; // of the series in x / 64
  const double y = halvings * (x < 40 ? x : 40);
  double power = 1;
  for (int n = terms; n > 0; --n)
  {
    power = 1 - y * power * (1. / n);
  }
  for (double left = 1; left > halvings; left *= 0.5)
  {
    power *= power;
  }
  return power;
}

/// What numerical schlieren images of computed flows show, exp(-c |grad rho| / max |grad rho|) (Quirk 1994), dark on white.
/// No stop of a bench does that: I = exp(-5 k |eps|). In a plane flow |eps| is in proportion to |grad rho|.
struct NumericalSchlieren
{
  static constexpr int channels = 1;
  static constexpr double atFullScale = 5; ///< c, where k |eps| is 1

  double k;

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    light[0] = exponentialOfMinus(atFullScale * distanceFromAxis(k, ray.deflection));
  }
  SCHLIEREN_HD bool saturates(const double (&eps)[2]) const { return distanceFromAxis(k, eps) > 1; }
};

} // namespace schlieren
