// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays of one image traced by several processes: one has the medium and the image (TeamTracer), the others are its
// workers. They get what rays need of the medium, as a GPU does, then tiles to trace, and send back what rays hand on:
// 40 bytes a ray, and 4 for each field that it gathers. Whoever traces a tile, its rays are the same to the last bit.
#pragma once

#include "Medium/Medium.h"
#include "Rays/Channel.h"
#include "Rays/CudaTracer.h"
#include "Rays/Tracer.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace schlieren
{

/// Traces rays with the CPUs or the CUDA devices of this process and of workers, never with both: they round differently.
/// Knows what these have of the medium.
template <class Real>
class TeamTracer
{
public:
  /// The medium must outlive it, and not change.
  explicit TeamTracer(const Medium<Real>& medium);
  ~TeamTracer();

  /// As traceOnCpu. What workers do not trace, this process does: it needs none of them.
  bool trace(const RayTask<Real>& task, const Pass& pass, const TaskVersions& versions,
    const std::vector<Channel*>& workers, TracedPass& traced, int threads, const Monitor& monitor);

  /// The same on the CUDA devices of this process and of those workers that have one of the same compute capability.
  /// `own` is this process's, with the medium.
  bool traceOnCuda(CudaTracer<Real>& own, typename CudaTracer<Real>::Exits exits,
    const RayTask<Real>& task, const Pass& pass, const TaskVersions& versions,
    const std::vector<Channel*>& workers, TracedPass& traced, const Monitor& monitor);
  int workersOnCuda() const; ///< as far as they have answered

private:
  struct State;
  struct Exchange;
  const Medium<Real>& medium_;
  std::unique_ptr<State> state_;
};

} // namespace schlieren
