// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Medium.h"
#include "Rays/BrickChannels.h"
#include "Rays/DistributedRays.h"
#include "Rays/Tracer.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace schlieren
{

/// Traces rays through a tree whose bricks several processes have, see BrickOwners. It begins all rays, takes them through
/// its own part, and collects those that end; workers hand on rays to each other.
template <class Real>
class DistributedTracer
{
public:
  /// Both must outlive it, and the medium must not change. It must be a tree with these owners.
  DistributedTracer(const Medium<Real>& medium, const BrickChannels& owners);
  ~DistributedTracer();

  /// As traceOnCpu, where canSuspend(): rays are the same but for rounding, and the same to the last bit whatever the
  /// number of processes. These must have the instructions. Throws Error where a worker does not answer: nobody else has its part.
  bool trace(const RayTask<Real>& task, const Pass& pass, TracedPass& traced, int threads,
    const Monitor& monitor, Simd simd = bestSimd());

  /// What has been sent since the beginning: between this process and workers, in both directions, and by workers to
  /// each other.
  struct Traffic
  {
    RayTraffic own, amongWorkers;
  };
  const Traffic& traffic() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace schlieren
