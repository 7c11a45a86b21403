// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Rays/RayExit.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

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

/// Bins of numbers of 0 or more by their leading bits, which grow with them.
struct LeadingBits
{
  static constexpr int bits = 16; ///< sign, exponent and 4 bits of the fraction
  static constexpr std::size_t count = std::size_t{ 1 } << bits;

  static SCHLIEREN_HD std::size_t of(double value)
  {
    std::uint64_t all = 0;
    std::memcpy(&all, &value, sizeof(all));
    return static_cast<std::size_t>(all >> (64 - bits));
  }
};

/// Measures how strongly a ray is bent.
SCHLIEREN_HD double squaredDeflection(const RayExit& exit)
{
  return exit.deflection[0] * exit.deflection[0] + exit.deflection[1] * exit.deflection[1];
}

} // namespace schlieren
