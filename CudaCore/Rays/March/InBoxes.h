// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Places and lines in boxes, of one ray or of a pack of them.
#pragma once

#include "Math/Pack.h"
#include "Math/Vec3.h"

#include <limits>

namespace schlieren
{

template <class Real>
constexpr Real infinite = std::numeric_limits<Real>::infinity();

/// NaN becomes 0.
template <class Real, class Number>
SCHLIEREN_HD Real clampTo(const Real& x, const Number& last)
{
  return minimum(maximum(x, Real{}), Real{} + last);
}

template <class Real, class Number>
SCHLIEREN_HD Vec3<Real> clampTo(const Vec3<Real>& x, const Vec3<Number>& last)
{
  return { clampTo(x.x, last.x), clampTo(x.y, last.y), clampTo(x.z, last.z) };
}

/// The least of three.
template <class Real>
SCHLIEREN_HD Real leastOf(const Vec3<Real>& a)
{
  return minimum(a.x, minimum(a.y, a.z));
}

/// How far inside the box [low, high] a place is, along the axis where that is least.
template <class Real, class Box>
SCHLIEREN_HD Real insetOf(const Vec3<Real>& x, const Vec3<Box>& low, const Vec3<Box>& high)
{
  const Real ofX = minimum(x.x - low.x, high.x - x.x);
  const Real ofY = minimum(x.y - low.y, high.y - x.y);
  const Real ofZ = minimum(x.z - low.z, high.z - x.z);
  return minimum(ofX, minimum(ofY, ofZ));
}

/// The length along a line from x to where it leaves the box [low, high] on one axis; negative if it has.
template <class Real, class Box>
SCHLIEREN_HD Real wayOut(const Real& x, const Real& along, const Box& low, const Box& high)
{
  const Real side = along > 0 ? Real{} + high : Real{} + low;
  const Real distance = (side - x) / along;
  return along == 0 ? Real{} + infinite<NumberOf<Real>> : distance;
}

template <class Real, class Box>
SCHLIEREN_HD Real wayOut(
  const Vec3<Real>& x, const Vec3<Real>& along, const Vec3<Box>& low, const Vec3<Box>& high)
{
  return minimum(wayOut(x.x, along.x, low.x, high.x),
    minimum(wayOut(x.y, along.y, low.y, high.y), wayOut(x.z, along.z, low.z, high.z)));
}

} // namespace schlieren
