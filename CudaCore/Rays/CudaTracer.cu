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

template <class Interpolate, class Real>
__global__ void traceKernel(
  const RayTask<Real> task, const Pass pass, std::int64_t first, std::int64_t count, RayExit* exits)
{
  const std::int64_t n = blockIdx.x * static_cast<std::int64_t>(blockDim.x) + threadIdx.x;
  if (n < count)
  {
    exits[n] = traceRay<Interpolate>(task, pass.columnOf(first + n), pass.rowOf(first + n));
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
  {
    if (!medium.solid.empty())
    {
      solid = std::make_unique<CudaBuffer<std::uint32_t, DeviceError>>(
        medium.solid.data(), medium.solid.size());
    }
  }

  CudaBuffer<Real, DeviceError> samples;
  CudaBuffer<RayExit, DeviceError> exits;
  std::unique_ptr<CudaBuffer<std::uint32_t, DeviceError>> solid;
};

template <class Real>
CudaTracer<Real>::CudaTracer(const Medium<Real>& medium)
  : memory_(std::make_unique<DeviceMemory>(medium))
{
}

template <class Real>
CudaTracer<Real>::~CudaTracer() = default;

template <class Real>
bool CudaTracer<Real>::trace(const RayTask<Real>& task, Interpolation interpolation,
  const Pass& pass, RayExit* exits, const Monitor& monitor)
{
  RayTask<Real> onDevice = task;
  onDevice.medium.samples = memory_->samples.data();
  onDevice.medium.solid = memory_->solid ? memory_->solid->data() : nullptr;

  const std::int64_t rays = pass.columns * pass.rows;
  for (std::int64_t first = 0; first < rays; first += raysPerLaunch)
  {
    const std::int64_t count = std::min(raysPerLaunch, rays - first);
    const auto blocks = static_cast<unsigned>((count + threadsPerBlock - 1) / threadsPerBlock);
    if (interpolation == Interpolation::Quadratic)
    {
      traceKernel<QuadraticInterpolation>
        <<<blocks, threadsPerBlock>>>(onDevice, pass, first, count, memory_->exits.data());
    }
    else
    {
      traceKernel<LinearInterpolation>
        <<<blocks, threadsPerBlock>>>(onDevice, pass, first, count, memory_->exits.data());
    }
    checkCuda<DeviceError>(cudaGetLastError(), "Starting the ray kernel");
    checkCuda<DeviceError>(
      cudaMemcpy(exits + first, memory_->exits.data(),
        static_cast<std::size_t>(count) * sizeof(RayExit), cudaMemcpyDeviceToHost),
      "Tracing rays");
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
