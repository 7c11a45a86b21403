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

/// What rays need of a medium, on the host.
template <class Real>
struct MediumArrays
{
  template <class T>
  struct Array
  {
    const T* first = nullptr;
    std::size_t count = 0;
  };

  MediumView<Real> view{};
  Array<Real> samples{};
  Array<std::uint32_t> solid{};
  // Of a tree.
  Array<Leaf<Real>> leaves{};
  Array<std::int32_t> roots{}, children{};
  Array<std::int16_t> gasDistances{};

  static MediumArrays of(const Medium<Real>& medium);
};

/// Traces rays on the CUDA device that cudaAvailable has chosen. Holds in its memory what rays need, from pass to pass: the medium.
/// Throws DeviceError, OutOfDeviceMemory where the medium does not fit.
template <class Real>
class CudaTracer
{
public:
  explicit CudaTracer(const MediumArrays<Real>& medium);
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

  /// Makes room for the rays of passes: in traced.onDevice, and on the host where they are wanted there.
  void begin(const Passes& passes, Exits exits, TracedPass& traced) const;
  /// After begin(), in the same thread: traces consecutive bands until the monitor stops it, and adds to what `traced` counts.
  /// Returns false if aborted.
  bool traceBands(const RayTask<Real>& task, const Passes& passes, Exits exits, const Tiles& bands,
    TracedPass& traced, const Monitor& monitor);

private:
  struct DeviceMemory;
  std::unique_ptr<DeviceMemory> memory_;
};

} // namespace schlieren
