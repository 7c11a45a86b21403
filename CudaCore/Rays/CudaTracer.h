// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/DeviceError.h"
#include "Medium/Medium.h"
#include "Rays/Tracer.h"

#include <cstdint>
#include <memory>

namespace schlieren
{

/// Traces rays on the CUDA device that cudaAvailable has chosen. Holds in its memory what rays need, from pass to pass: the medium,
/// the homogeneity map, the gradients of fields. Throws DeviceError.
template <class Real>
class CudaTracer
{
public:
  explicit CudaTracer(const Medium<Real>& medium);
  ~CudaTracer();

  /// Where rays are wanted.
  enum class Exits
  {
    OnHost,
    OnDevice ///< for CudaFilm; what they gather is lost
  };

  /// Traces a pass, as traceOnCpu does. Returns false if aborted.
  bool trace(const RayTask<Real>& task, const Pass& pass, const TaskVersions& versions, Exits exits,
    TracedPass& traced, const Monitor& monitor);

private:
  struct DeviceMemory;
  std::unique_ptr<DeviceMemory> memory_;
};

} // namespace schlieren
