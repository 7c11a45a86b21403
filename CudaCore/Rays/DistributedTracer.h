// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Medium.h"
#include "Rays/Channel.h"
#include "Rays/Tracer.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace schlieren
{

/// Traces rays through a tree of which each of the workers gets a part and this process keeps one, see MediumParts. It
/// begins all rays, passes on those that come from one part to another, and collects what becomes of them.
template <class Real>
class DistributedTracer
{
public:
  /// The medium must outlive it, and not change. It must be a tree.
  explicit DistributedTracer(const Medium<Real>& medium);
  ~DistributedTracer();

  /// As traceOnCpu with Simd::None. Throws Error where a worker does not answer: nobody else has its part.
  bool trace(const RayTask<Real>& task, const Pass& pass, const std::vector<Channel*>& workers,
    TracedPass& traced, int threads, const Monitor& monitor);

  /// What has been sent between processes since the beginning, in both directions.
  struct Traffic
  {
    std::int64_t messages = 0, bytes = 0; ///< with rays
    std::int64_t states = 0;              ///< of rays, to workers
    std::int64_t bytesOfMedium = 0;
    std::int64_t largestPart = 0; ///< of these, to one worker
  };
  const Traffic& traffic() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace schlieren
