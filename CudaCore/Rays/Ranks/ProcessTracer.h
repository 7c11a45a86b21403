// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays of one image traced by several ranks: one has the medium and the image (ProcessTracer), the others have
// RayWorkers. These get what rays need of the medium, as a GPU does, and send back what rays hand on: 40 bytes a ray.
// Whoever traces a tile, its rays are the same to the last bit.
#pragma once

#include "Rays/March/RayTask.h"
#include "Rays/Ranks/Processes.h"
#include "Rays/TracedPass.h"

#include <memory>

namespace schlieren
{

/// Traces rays with the CPUs of this rank and of others.
template <class Real>
class ProcessTracer
{
public:
  /// The medium must outlive it, and not change.
  explicit ProcessTracer(const Medium<Real>& medium);
  ~ProcessTracer();

  /// Traces passes, or resumes them, as traceOnCpu() does.
  bool trace(const RayTask<Real>& task, const Passes& passes, Processes& processes,
    TracedPass& traced, int threads, const Monitor& monitor);

private:
  struct State;
  const Medium<Real>& medium_;
  std::unique_ptr<State> state_;
};

} // namespace schlieren
