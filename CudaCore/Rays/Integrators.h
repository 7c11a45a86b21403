// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Interpolation.h"

namespace schlieren
{

/// A ray in the perturbation form: position = start + length * W + offset and p = w + q, so that what
/// is integrated is only the deviation from the straight ray, in full relative precision however weak
/// the medium is. Positions and offsets are in index coordinates, q and p along the grid's axes.
template <class Real>
struct Ray
{
  Vec3<Real> start;
  Vec3<Real> offset{ 0, 0, 0 };
  Vec3<Real> q{ 0, 0, 0 };
  Real length = 0; ///< travelled, in units of the light's unit of length
};

/// What an integrator needs to know about the undisturbed light.
template <class Real>
struct StraightLight
{
  Vec3<Real> w;          ///< direction, along the grid's axes
  Vec3<Real> perLength;  ///< W: index coordinates per unit of length
  Vec3<Real> indexScale; ///< index coordinates per unit of length along each grid axis
};

/// Leapfrog: half a drift, a kick, half a drift (Verlet 1967; symplectic, second order). One gradient
/// a step: dx/ds = w + q, dq/ds = (1 + nu) grad nu (Sharma, Kumar & Ghatak 1982, with n
/// measured against the ambient index).
struct Leapfrog
{
  /// Where the step's gradient is wanted.
  template <class Real>
  SCHLIEREN_HD static Vec3<Real> midpoint(
    const Ray<Real>& ray, const StraightLight<Real>& light, Real step)
  {
    const Real half = step / 2;
    return ray.start + (ray.length + half) * light.perLength + ray.offset +
      half * scaled(light.indexScale, ray.q);
  }

  /// Takes the step; returns its share of the optical path difference. That is the integral of n ds
  /// less the way of the plane wave that meets the ray at its end, 2 nu + nu^2 - q.w. With |p| = 1 + nu
  /// it equals nu + (nu^2 + |q|^2) / 2, in which an error of q.w, a sum of many kicks, counts only to
  /// second order.
  template <class Real>
  SCHLIEREN_HD static double advance(
    Ray<Real>& ray, const StraightLight<Real>& light, Real step, const Sample<Real>& middle)
  {
    const Vec3<Real> before = ray.q;
    ray.q += (step * (1 + middle.value)) * scaled(light.indexScale, middle.gradient);
    const Vec3<Real> sum = before + ray.q;
    ray.offset += (step / 2) * scaled(light.indexScale, sum);
    ray.length += step;
    return static_cast<double>(
      step * (middle.value + (middle.value * middle.value + dot(sum, sum) / 4) / 2));
  }
};

} // namespace schlieren
