// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/Pack.h"

#include <cmath>

namespace schlieren
{

/// Three numbers, or three packs of numbers. Both may stand together in one expression.
template <class Real>
struct Vec3
{
  Real x, y, z;

  SCHLIEREN_HD Vec3& operator+=(const Vec3& b)
  {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }

  template <class Other>
  SCHLIEREN_HD explicit operator Vec3<Other>() const
  {
    return { static_cast<Other>(x), static_cast<Other>(y), static_cast<Other>(z) };
  }
};

template <class A, class B>
SCHLIEREN_HD auto operator+(const Vec3<A>& a, const Vec3<B>& b) -> Vec3<decltype(a.x + b.x)>
{
  return { a.x + b.x, a.y + b.y, a.z + b.z };
}

template <class A, class B>
SCHLIEREN_HD auto operator-(const Vec3<A>& a, const Vec3<B>& b) -> Vec3<decltype(a.x - b.x)>
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}

template <class Scale, class Real>
SCHLIEREN_HD auto operator*(const Scale& s, const Vec3<Real>& a) -> Vec3<decltype(s * a.x)>
{
  return { s * a.x, s * a.y, s * a.z };
}

/// Product component by component.
template <class A, class B>
SCHLIEREN_HD auto scaled(const Vec3<A>& a, const Vec3<B>& b) -> Vec3<decltype(a.x * b.x)>
{
  return { a.x * b.x, a.y * b.y, a.z * b.z };
}

template <class A, class B>
SCHLIEREN_HD auto dot(const Vec3<A>& a, const Vec3<B>& b) -> decltype(a.x * b.x)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
SCHLIEREN_HD Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/// The numbers of packs, lane by lane.
template <class Real>
SCHLIEREN_HD Vec3<Real> packsOf(const NumberOf<Real> (&from)[3][lanesOf<Real>])
{
  return { fromArray<Real>(from[0]), fromArray<Real>(from[1]), fromArray<Real>(from[2]) };
}

template <class Real>
SCHLIEREN_HD void toArrays(const Vec3<Real>& from, NumberOf<Real> (&to)[3][lanesOf<Real>])
{
  toArray(from.x, to[0]);
  toArray(from.y, to[1]);
  toArray(from.z, to[2]);
}

/// `a` where `which`, elsewhere `b`.
template <class Mask, class Real>
SCHLIEREN_HD Vec3<Real> either(const Mask& which, const Vec3<Real>& a, const Vec3<Real>& b)
{
  return { which ? a.x : b.x, which ? a.y : b.y, which ? a.z : b.z };
}

/// Into the box [low, high]; NaN becomes `low`.
template <class Real, class Number>
SCHLIEREN_HD Vec3<Real> clampTo(
  const Vec3<Real>& x, const Vec3<Number>& low, const Vec3<Number>& high)
{
  return { minimum(maximum(x.x, Real{} + low.x), Real{} + high.x),
    minimum(maximum(x.y, Real{} + low.y), Real{} + high.y),
    minimum(maximum(x.z, Real{} + low.z), Real{} + high.z) };
}

template <class Real>
SCHLIEREN_HD Real length(const Vec3<Real>& a)
{
  return std::sqrt(dot(a, a));
}

} // namespace schlieren
