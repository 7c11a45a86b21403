// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What code needs in order to be written once for numbers and for packs of numbers, one of each of
// several rays (SimdPack.h). Arithmetic, comparisons and ?: are the language's own.
#pragma once

#include "Math/HostDevice.h"

#include <cmath>
#include <cstdint>
#include <type_traits>

namespace schlieren
{

/// Of a number: a pack with one lane.
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

/// Of a pack of numbers or of what comparing packs gives.
template <class Pack>
SCHLIEREN_HD auto lane(const Pack& pack, int i)
{
  if constexpr (std::is_arithmetic_v<Pack>)
  {
    return pack;
  }
  else
  {
    return pack[i];
  }
}
template <class Pack>
SCHLIEREN_HD void setLane(Pack& pack, int i, NumberOf<Pack> to)
{
  if constexpr (std::is_arithmetic_v<Pack>)
  {
    pack = to;
  }
  else
  {
    pack[i] = to;
  }
}

template <class Real>
SCHLIEREN_HD Real lesser(const Real& a, const Real& b)
{
  return a < b ? a : b;
}
template <class Real>
SCHLIEREN_HD Real greater(const Real& a, const Real& b)
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
    Real root{};
    for (int i = 0; i < lanesOf<Real>; ++i)
    {
      root[i] = static_cast<NumberOf<Real>>(std::sqrt(a[i]));
    }
    return root;
  }
}

} // namespace schlieren
