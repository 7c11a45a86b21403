// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What code needs in order to be written once for numbers and for packs of numbers, one of each of
// several rays (SimdPack.h). Arithmetic, comparisons and ?: are the language's own.
#pragma once

#include "Math/HostDevice.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace schlieren
{

/// Describes a number as a pack with one lane.
template <class Real>
struct PackTraits
{
  using Number = Real;
  using Int = std::int32_t; ///< an integer per lane
  static constexpr int lanes = 1;
};

template <class Real>
using NumberOf = typename PackTraits<Real>::Number;
template <class Real>
using IntOf = typename PackTraits<Real>::Int;
template <class Real>
constexpr int lanesOf = PackTraits<Real>::lanes;

SCHLIEREN_HD bool any(bool condition) { return condition; }

/// The numbers of a pack, lane by lane.
template <class Real>
SCHLIEREN_HD Real fromArray(const NumberOf<Real> (&array)[lanesOf<Real>])
{
  Real pack;
  memcpy(&pack, array, sizeof(pack));
  return pack;
}
template <class Real>
SCHLIEREN_HD void toArray(const Real& pack, NumberOf<Real> (&array)[lanesOf<Real>])
{
  memcpy(array, &pack, sizeof(pack));
}

template <class Real>
SCHLIEREN_HD Real minimum(const Real& a, const Real& b)
{
  return a < b ? a : b;
}
template <class Real>
SCHLIEREN_HD Real maximum(const Real& a, const Real& b)
{
  return a > b ? a : b;
}

template <class Real>
SCHLIEREN_HD Real squareRoot(const Real& a)
{
  if constexpr (lanesOf<Real> == 1)
  {
    return std::sqrt(a);
  }
  else
  {
    NumberOf<Real> roots[lanesOf<Real>];
    toArray(a, roots);
    for (NumberOf<Real>& root : roots)
    {
      root = std::sqrt(root);
    }
    return fromArray<Real>(roots);
  }
}

} // namespace schlieren
