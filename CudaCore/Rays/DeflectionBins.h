// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Rays/RayExit.h"

#include <cmath>
#include <cstdint>

namespace schlieren
{

/// Squares that deflections are counted in, along u and v. Their range is a power of two, which rounds nothing, so that
/// all ranges agree on where a ray belongs.
struct DeflectionBins
{
  std::int64_t count; ///< along each axis, an even number
  int exponent;       ///< they cover -2^exponent ... 2^exponent

  static SCHLIEREN_HD bool counts(const RayExit& exit)
  {
    return exit.reachesFilm() && std::isfinite(exit.deflection[0]) &&
      std::isfinite(exit.deflection[1]);
  }
  SCHLIEREN_HD std::int64_t of(const RayExit& exit) const
  {
    return of(exit.deflection[1]) * count + of(exit.deflection[0]);
  }

private:
  SCHLIEREN_HD std::int64_t of(double deflection) const
  {
    const auto half = static_cast<double>(count / 2);
    return static_cast<std::int64_t>(floor(ldexp(deflection * half, -exponent)) + half);
  }
};

} // namespace schlieren
