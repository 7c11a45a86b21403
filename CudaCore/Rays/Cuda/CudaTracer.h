// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/DeviceError.h"
#include "Rays/March/MakeTask.h"
#include "Rays/Tiles.h"
#include "Rays/TracedPass.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace schlieren
{

/// Traces rays on the CUDA device that cudaAvailable has chosen. Holds in its memory what rays need, from pass to pass: the medium.
/// Throws DeviceError, OutOfDeviceMemory where the medium does not fit.
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
    OnDevice ///< for CudaFilm
  };

  /// Traces passes, as traceOnCpu does. Returns false if aborted.
  bool trace(const RayTask<Real>& task, const Passes& passes, Exits exits, TracedPass& traced,
    const Monitor& monitor);

private:
  struct DeviceMemory;
  std::unique_ptr<DeviceMemory> memory_;
};

} // namespace schlieren
