// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/DeviceError.h"
#include "Medium/Medium.h"
#include "Rays/Tracer.h"

#include <memory>

namespace schlieren
{

/// Traces rays on the first CUDA device; holds the medium in its memory. Throws DeviceError.
template <class Real>
class CudaTracer
{
public:
  explicit CudaTracer(const Medium<Real>& medium);
  ~CudaTracer();

  /// Traces a pass into host memory, as traceOnCpu does. Returns false if aborted.
  /// The gradients are sent to the device again only when `version` is another.
  bool trace(const RayTask<Real>& task, const KernelChoice& kernel, const Pass& pass,
    std::uint64_t version, TracedPass& traced, const Monitor& monitor);

private:
  struct DeviceMemory;
  std::unique_ptr<DeviceMemory> memory_;
};

} // namespace schlieren
