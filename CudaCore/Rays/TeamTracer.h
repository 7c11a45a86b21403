// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays of one image traced by several processes: one has the medium and the image (TeamTracer), the others are its
// workers. They get what rays need of the medium, as a GPU does, then tiles to trace, and send back what rays hand on:
// 40 bytes a ray, and 4 for each field that it gathers. Whoever traces a tile, its rays are the same to the last bit.
#pragma once

#include "Medium/Medium.h"
#include "Rays/Channel.h"
#include "Rays/Tracer.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace schlieren
{

/// Traces rays on the CPU of this process and on those of workers. Knows what these have of the medium.
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

private:
  struct State;
  const Medium<Real>& medium_;
  std::unique_ptr<State> state_;
};

} // namespace schlieren
