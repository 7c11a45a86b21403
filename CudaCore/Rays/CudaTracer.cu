// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/CudaBuffer.h"
#include "Rays/CudaTracer.h"

#include <algorithm>

namespace schlieren
{

namespace
{

constexpr int threadsPerBlock = 128;
constexpr std::int64_t raysPerLaunch = std::int64_t{ 1 } << 20;

/// `gathered`: the sums of each ray's fields, null where there are none.
template <class Kernel, class Real>
__global__ void traceKernel(const RayTask<Real> task, const Pass pass, std::int64_t first,
  std::int64_t count, RayExit* exits, float* gathered, Real* drifts)
{
  const std::int64_t n = blockIdx.x * static_cast<std::int64_t>(blockDim.x) + threadIdx.x;
  if (n < count)
  {
    float* sums = gathered + n * task.gradients.count;
    for (int field = 0; field < task.gradients.count; ++field)
    {
      sums[field] = 0;
    }
    exits[n] =
      traceRay<Kernel>(task, pass.columnOf(first + n), pass.rowOf(first + n), sums, drifts[n]);
  }
}

} // namespace

bool cudaAvailable(std::string* reason)
{
  int devices = 0;
  const cudaError_t status = cudaGetDeviceCount(&devices);
  if (status == cudaSuccess && devices > 0)
  {
    return true;
  }
  cudaGetLastError();
  if (reason != nullptr)
  {
    *reason = status == cudaSuccess ? "no CUDA device was found" : cudaGetErrorString(status);
  }
  return false;
}

template <class Real>
struct CudaTracer<Real>::DeviceMemory
{
  explicit DeviceMemory(const Medium<Real>& medium)
    : samples(medium.volume.samples.data(), medium.volume.samples.size())
    , exits(static_cast<std::size_t>(raysPerLaunch))
    , drifts(static_cast<std::size_t>(raysPerLaunch))
  {
    if (!medium.solid.empty())
    {
      solid = std::make_unique<CudaBuffer<std::uint32_t, DeviceError>>(
        medium.solid.data(), medium.solid.size());
    }
  }

  CudaBuffer<Real, DeviceError> samples;
  CudaBuffer<RayExit, DeviceError> exits;
  CudaBuffer<Real, DeviceError> drifts;
  std::unique_ptr<CudaBuffer<std::uint32_t, DeviceError>> solid;

  /// Fields that tint, and what the rays of one launch have gathered of them.
  struct Gathering
  {
    Gathering(const FieldGradientsView& view, std::uint64_t versionOfValues)
      : version(versionOfValues)
      , gradients(view.values,
          static_cast<std::size_t>(
            view.count * view.dimensions[0] * view.dimensions[1] * view.dimensions[2]))
      , sums(static_cast<std::size_t>(view.count * raysPerLaunch))
    {
    }
    std::uint64_t version;
    CudaBuffer<float, DeviceError> gradients;
    CudaBuffer<float, DeviceError> sums;
  };
  std::unique_ptr<Gathering> gathering;

  /// Makes the view one of device memory; gives back where to put the sums.
  float* bring(FieldGradientsView& view, std::uint64_t version)
  {
    if (view.count == 0)
    {
      return nullptr;
    }
    if (!gathering || gathering->version != version)
    {
      gathering.reset(); // first: both at once might not fit
      gathering = std::make_unique<Gathering>(view, version);
    }
    view.values = gathering->gradients.data();
    return gathering->sums.data();
  }
};

template <class Real>
CudaTracer<Real>::CudaTracer(const Medium<Real>& medium)
  : memory_(std::make_unique<DeviceMemory>(medium))
{
}

template <class Real>
CudaTracer<Real>::~CudaTracer() = default;

template <class Real>
bool CudaTracer<Real>::trace(const RayTask<Real>& task, const KernelChoice& kernel,
  const Pass& pass, std::uint64_t version, TracedPass& traced, const Monitor& monitor)
{
  RayTask<Real> onDevice = task;
  onDevice.medium.samples = memory_->samples.data();
  onDevice.medium.solid = memory_->solid ? memory_->solid->data() : nullptr;
  onDevice.map.levels = nullptr;
  float* sums = memory_->bring(onDevice.gradients, version);
  const int fields = task.gradients.count;

  const std::int64_t rays = pass.columns * pass.rows;
  std::vector<Real> drifts(static_cast<std::size_t>(std::min(raysPerLaunch, rays)));
  traced.worstDrift = 0;
  for (std::int64_t first = 0; first < rays; first += raysPerLaunch)
  {
    const std::int64_t count = std::min(raysPerLaunch, rays - first);
    const auto blocks = static_cast<unsigned>((count + threadsPerBlock - 1) / threadsPerBlock);
    visitKernel(kernel,
      [&](auto kind)
      {
        traceKernel<decltype(kind)><<<blocks, threadsPerBlock>>>(
          onDevice, pass, first, count, memory_->exits.data(), sums, memory_->drifts.data());
      });
    checkCuda<DeviceError>(cudaGetLastError(), "Starting the ray kernel");
    checkCuda<DeviceError>(
      cudaMemcpy(traced.exits.data() + first, memory_->exits.data(),
        static_cast<std::size_t>(count) * sizeof(RayExit), cudaMemcpyDeviceToHost),
      "Tracing rays");
    checkCuda<DeviceError>(
      cudaMemcpy(drifts.data(), memory_->drifts.data(),
        static_cast<std::size_t>(count) * sizeof(Real), cudaMemcpyDeviceToHost),
      "Tracing rays");
    for (std::int64_t ray = 0; ray < count; ++ray)
    {
      traced.worstDrift =
        std::max(traced.worstDrift, static_cast<double>(drifts[static_cast<std::size_t>(ray)]));
    }
    if (fields > 0)
    {
      checkCuda<DeviceError>(
        cudaMemcpy(traced.gathered.data() + first * fields, sums,
          static_cast<std::size_t>(count * fields) * sizeof(float), cudaMemcpyDeviceToHost),
        "Gathering gradients");
    }
    if (monitor.progress)
    {
      monitor.progress(static_cast<double>(first + count) / static_cast<double>(rays));
    }
    if (monitor.aborted && monitor.aborted())
    {
      return false;
    }
  }
  return true;
}

template class CudaTracer<float>;
template class CudaTracer<double>;

} // namespace schlieren
