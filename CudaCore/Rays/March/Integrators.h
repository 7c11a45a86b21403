// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How a ray takes its steps. Real is a number or a pack of numbers, a ray or a pack of rays.
//
//   dx/ds = d + q, dq/ds = (1 + nu) grad nu     (Sharma, Kumar & Ghatak 1982, with n measured against
//                                                the ambient index), ds = path / n
//
// An integrator has
//   samplesBeyond    whether it looks at more, or at other places, than the step's middle
//   advance          takes one step; `sample(position)` is the medium there
// and the adaptive one an attempt in place of that, and its own choice of steps (Adaptive below).
#pragma once

#include "Medium/Samples/Interpolation.h"

namespace schlieren
{

/// A ray in the perturbation form: position = start + length * D + offset and p = d + q, so that what
/// is integrated is only the deviation from the straight ray, in full relative precision however weak
/// the medium is. Positions and offsets are in local coordinates of the leaf that the ray is in, q and p along
/// the grid's axes.
template <class Real>
struct Ray
{
  Vec3<Real> start;
  Vec3<Real> offset;
  Vec3<Real> q;
  Real length; ///< travelled from `start`, in units of the light's unit of length
  Real path;   ///< of the optical path difference; with pathError a compensated sum (Kahan 1965)
  Real pathError;

  SCHLIEREN_HD void addPath(const Real& fraction)
  {
    const Real more = fraction - pathError;
    const Real sum = path + more;
    pathError = (sum - path) - more;
    path = sum;
  }
};

/// What an integrator needs to know about the undisturbed light.
template <class Real>
struct StraightLight
{
  Vec3<Real> d;          ///< direction, along the grid's axes
  Vec3<Real> perLength;  ///< D: local coordinates of the leaf per unit of length
  Vec3<Real> indexScale; ///< the same along each grid axis
};

/// The ray bends.
struct RefractedPath
{
  static constexpr bool bends = true;

  template <class Real>
  SCHLIEREN_HD static Vec3<Real> position(const Ray<Real>& ray, const StraightLight<Real>& light)
  {
    return ray.start + ray.length * light.perLength + ray.offset;
  }
  /// dx/ds in index coordinates.
  template <class Real>
  SCHLIEREN_HD static Vec3<Real> along(const Ray<Real>& ray, const StraightLight<Real>& light)
  {
    return light.perLength + scaled(light.indexScale, ray.q);
  }
  /// The position that a straight step from here leads to.
  template <class Real>
  SCHLIEREN_HD static Vec3<Real> ahead(
    const Ray<Real>& ray, const StraightLight<Real>& light, const Real& step)
  {
    return ray.start + (ray.length + step) * light.perLength +
      (ray.offset + scaled(step * light.indexScale, ray.q));
  }
  /// dq/ds.
  template <class Real>
  SCHLIEREN_HD static Vec3<Real> kick(const Sample<Real>& at, const StraightLight<Real>& light)
  {
    return (1 + at.value) * scaled(light.indexScale, at.gradient);
  }
  /// Derivative of the optical path difference by s. The integral of n ds less the path of the plane wave that meets
  /// the ray at its end, along d, is that of 2 nu + nu^2 - q.d. With |p| = 1 + nu it equals
  /// nu + (nu^2 + |q|^2) / 2, in which an error of q.d, a sum of many kicks, counts only to second order.
  template <class Real>
  SCHLIEREN_HD static Real phase(const Real& nu, const Real& qSquared)
  {
    return nu + NumberOf<Real>(0.5) * (nu * nu + qSquared);
  }
};

/// Line of sight: the medium is looked at along the straight ray, and what that does to it is summed up
/// to first order. `offset` is the displacement that follows from it.
struct StraightPath
{
  static constexpr bool bends = false;

  template <class Real>
  SCHLIEREN_HD static Vec3<Real> position(const Ray<Real>& ray, const StraightLight<Real>& light)
  {
    return ray.start + ray.length * light.perLength;
  }
  template <class Real>
  SCHLIEREN_HD static Vec3<Real> along(const Ray<Real>&, const StraightLight<Real>& light)
  {
    return light.perLength;
  }
  template <class Real>
  SCHLIEREN_HD static Vec3<Real> ahead(
    const Ray<Real>& ray, const StraightLight<Real>& light, const Real& step)
  {
    return ray.start + (ray.length + step) * light.perLength;
  }
  template <class Real>
  SCHLIEREN_HD static Vec3<Real> kick(const Sample<Real>& at, const StraightLight<Real>& light)
  {
    return scaled(light.indexScale, at.gradient);
  }
  template <class Real>
  SCHLIEREN_HD static Real phase(const Real& nu, const Real&)
  {
    return nu;
  }
};

/// Half a drift, a kick, half a drift (Verlet 1967): symplectic, one gradient a step.
struct Leapfrog
{
  static constexpr bool samplesBeyond = false;

  template <class Path, class Real, class SampleAt>
  SCHLIEREN_HD static void advance(Ray<Real>& ray, const StraightLight<Real>& light,
    const Real& step, const Vec3<Real>& middle, const SampleAt& sampleAt)
  {
    using Number = NumberOf<Real>;
    const Sample<Real> sample = sampleAt(middle);
    const Vec3<Real> before = ray.q;
    ray.q += step * Path::kick(sample, light);
    const Vec3<Real> sum = before + ray.q;
    ray.offset += (Number(0.5) * step) * scaled(light.indexScale, sum);
    ray.length += step;
    ray.addPath(step * Path::phase(sample.value, Number(0.25) * dot(sum, sum)));
  }
};

/// The slopes of a ray's state: by s of offset (with indexScale taken out), q and path.
template <class Real>
struct Slopes
{
  Vec3<Real> offset, q;
  Real path;

  template <class Path, class SampleAt>
  SCHLIEREN_HD static Slopes of(
    const Ray<Real>& ray, const StraightLight<Real>& light, const SampleAt& sampleAt)
  {
    const Sample<Real> sample = sampleAt(Path::position(ray, light));
    return { ray.q, Path::kick(sample, light), Path::phase(sample.value, dot(ray.q, ray.q)) };
  }
  /// The ray after a step with these slopes; its path is left to the caller.
  SCHLIEREN_HD Ray<Real> moved(
    const Ray<Real>& ray, const StraightLight<Real>& light, const Real& step) const
  {
    Ray<Real> there = ray;
    there.offset += step * scaled(light.indexScale, offset);
    there.q += step * q;
    there.length += step;
    return there;
  }
};
template <class Real, class Scale>
SCHLIEREN_HD Slopes<Real> operator*(const Scale& a, const Slopes<Real>& b)
{
  return { a * b.offset, a * b.q, a * b.path };
}
template <class Real>
SCHLIEREN_HD Slopes<Real> operator+(const Slopes<Real>& a, const Slopes<Real>& b)
{
  return { a.offset + b.offset, a.q + b.q, a.path + b.path };
}

/// The method of Bogacki & Shampine (1989), of third order with a second-order result to compare with.
/// The longest step is the tracer's; the others are as long as the tolerance allows.
struct Adaptive
{
  static constexpr bool samplesBeyond = true;

  template <class Real>
  struct Trial
  {
    Ray<Real> ray;
    Vec3<Real> qError;      ///< of q
    Vec3<Real> offsetError; ///< of the offset, in units of length
  };

  template <class Path, class Real, class SampleAt>
  SCHLIEREN_HD static Trial<Real> attempt(const Ray<Real>& ray, const StraightLight<Real>& light,
    const Real& step, const SampleAt& sampleAt)
  {
    using Number = NumberOf<Real>;
    // Butcher's tableau: stages at 0, 1/2, 3/4 and, for the comparison, at the end.
    const Number at[3] = { Number(0.5), Number(0.75), 1 };
    const Number third[3] = { Number(2. / 9), Number(1. / 3), Number(4. / 9) };
    const Number difference[4] = { Number(2. / 9 - 7. / 24), Number(1. / 3 - 1. / 4),
      Number(4. / 9 - 1. / 3), Number(-1. / 8) };
    Slopes<Real> slopes = Slopes<Real>::template of<Path>(ray, light, sampleAt);
    Slopes<Real> sum = third[0] * slopes;
    Slopes<Real> error = difference[0] * slopes;
    Ray<Real> there = ray;
    for (int stage = 0; stage < 3; ++stage)
    {
      // The third-order result is where the last stage is taken.
      there = stage < 2 ? slopes.moved(ray, light, at[stage] * step) : sum.moved(ray, light, step);
      slopes = Slopes<Real>::template of<Path>(there, light, sampleAt);
      if (stage < 2)
      {
        sum = sum + third[stage + 1] * slopes;
      }
      error = error + difference[stage + 1] * slopes;
    }
    there.addPath(step * sum.path);
    return { there, step * error.q, step * error.offset };
  }
};

/// Which of the tracer's kernels: types in one, so that each compiles to code of its own.
template <class PathKind, class IntegratorKind, class SchemeKind>
struct Kernel
{
  using Path = PathKind;
  using Integrator = IntegratorKind;
  using Scheme = SchemeKind;
};

} // namespace schlieren
