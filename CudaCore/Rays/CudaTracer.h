// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/DeviceError.h"
#include "Medium/Medium.h"
#include "Rays/Tracer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>

namespace schlieren
{

/// The compute capability of the device that cudaAvailable chooses, 10 times the first number and the second one: the
/// same kernels give the same rays on devices of the same one. 0: there is no device.
int cudaCapability();

/// Rows of a pass that are always traced by the same device: a band.
constexpr std::int64_t bandRows = 8;
inline std::int64_t bandsOf(const Pass& pass) { return (pass.rows + bandRows - 1) / bandRows; }

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
  Array<float> gradients{};
  Array<std::int32_t> gradientBricks{};
  std::ptrdiff_t firstGradient = 0; ///< where the view of the gradients begins

  static MediumArrays of(const Medium<Real>& medium);
};

/// Traces rays on the CUDA device that cudaAvailable has chosen. Holds in its memory what rays need, from pass to pass: the medium,
/// the homogeneity map, the gradients of fields. Throws DeviceError.
///
/// Of a tree that does not fit into the free memory, each pass sends one part after the other, in the order in which light
/// comes to them, and rays wait where they leave a part. That is for tasks that canSuspend() and gather nothing; their rays are
/// those of the whole medium but for rounding.
template <class Real>
class CudaTracer
{
public:
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

  /// The medium must outlive it. `memory`: of the device, in bytes, for the medium, and for the rays in it while they wait.
  explicit CudaTracer(const MediumArrays<Real>& medium, std::size_t memory = unlimited);
  explicit CudaTracer(const Medium<Real>& medium, std::size_t memory = unlimited);
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

  /// Makes room for the rays of a pass: in traced.onDevice, and on the host where they are wanted there.
  void begin(const RayTask<Real>& task, const Pass& pass, Exits exits, TracedPass& traced) const;
  /// After begin(), in the same thread: traces bands until none are left or the monitor stops it, and adds to what `traced` counts. Other
  /// processes may take bands meanwhile: `processes` says among how many those that are left are to be divided.
  bool traceBands(const RayTask<Real>& task, const Pass& pass, const TaskVersions& versions,
    Exits exits, TileQueue& bands, TracedPass& traced, const Monitor& monitor,
    const std::function<std::int64_t()>& processes = {});

  /// Whether all of the medium is on the device.
  bool hasAll() const;
  /// In how many parts the medium was sent for the last pass, or part of a pass; 1: it is there.
  int parts() const { return parts_; }

private:
  struct DeviceMemory;
  bool traceInParts(const RayTask<Real>& task, const Pass& pass, Exits exits, TileQueue& bands,
    TracedPass& traced, const Monitor& monitor);

  MediumArrays<Real> medium_;
  std::size_t limit_;
  int parts_ = 1;
  std::unique_ptr<DeviceMemory> memory_;
};

} // namespace schlieren
