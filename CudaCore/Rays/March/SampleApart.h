// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Samples of the medium by functions of their own, for steps that take several (Integrator::samplesBeyond).
#pragma once

#include "Rays/March/LeafOfRay.h"
#include "Rays/March/RayTask.h"

#include <cstdint>
#include <type_traits>

namespace schlieren
{

/// Replaces a scheme by the one that the task names, looked up for each sample. For integrators whose samples are a
/// function of their own anyway, so that their steps are compiled once for all schemes.
struct SchemeOfTask
{
};

/// A function of its own where a step takes several samples: in line, their code would be too much.
template <class Scheme, class Real>
SCHLIEREN_NOINLINE Sample<Real> sampleApart(
  const RayTask<NumberOf<Real>>& task, const std::int64_t* base, const Vec3<Real>& at)
{
  if constexpr (std::is_same_v<SchemeOfTask, Scheme>)
  {
    return visitScheme(task.kernel.interpolation,
      [&](auto scheme) { return interpolate<decltype(scheme)>(task.medium, base, at); });
  }
  else
  {
    return interpolate<Scheme>(task.medium, base, at);
  }
}

/// The medium at places that may be in other leaves than the rays.
template <class Scheme, class Real>
SCHLIEREN_HD Sample<Real> sampleAt(
  const RayTask<NumberOf<Real>>& task, const PlacesElsewhere<Real>& places)
{
  Sample<Real> found = sampleApart<Scheme>(
    task, places.base, clampTo(places.at, task.medium.leafLow, task.medium.leafHigh));
  found.value += places.value;
  found.gradient = places.finer * found.gradient;
  return found;
}

} // namespace schlieren
