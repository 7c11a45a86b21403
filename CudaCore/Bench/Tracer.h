// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Bench/MediumCache.h"
#include "Rays/March/RayTask.h"
#include "Rays/TracedPass.h"
#include "Types.h"

namespace schlieren
{

/// Traces all rays of a view, those of its image and those that look at it before: with the CPUs of this rank and of others, or
/// with their CUDA devices.
template <class Real>
class Tracer
{
public:
  /// `medium` and `processes` stay with their owner; null: there are no others.
  Tracer(MediumOnDevices<Real>& medium, Device device, Processes* processes, int threads)
    : medium_(&medium)
    , device_(device)
    , processes_(processes)
    , threads_(threads)
  {
  }

  /// The same of another medium, with this rank alone.
  Tracer in(MediumOnDevices<Real>& medium) const { return { medium, device_, nullptr, threads_ }; }

  /// Traces passes, or resumes them. False if aborted or paused: the same call then does the rest. Where they are traced by
  /// CPUs, `traced` has their size. `isWantedOnHost`: or else where it was traced. Throws DeviceError.
  bool trace(const RayTask<Real>& task, const Passes& passes, TracedPass& traced,
    const Monitor& monitor, bool isWantedOnHost = true) const;

  /// The same at once.
  TracedPass trace(const RayTask<Real>& task, const Passes& passes) const
  {
    TracedPass traced;
    traced.resize(passes);
    trace(task, passes, traced, {});
    return traced;
  }

private:
  MediumOnDevices<Real>* medium_;
  Device device_;
  Processes* processes_;
  int threads_;
};

} // namespace schlieren
