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

/// The same, with `gathered` for the sums of each ray.
template <class Interpolate, class Real>
__global__ void traceAndGatherKernel(const RayTask<Real> task, const Pass pass, std::int64_t first,
  std::int64_t count, RayExit* exits, const FieldGradientsView gradients, float* gathered)
{
  const std::int64_t n = blockIdx.x * static_cast<std::int64_t>(blockDim.x) + threadIdx.x;
  if (n < count)
  {
    float* sums = gathered + n * gradients.count;
    for (int field = 0; field < gradients.count; ++field)
    {
      sums[field] = 0;
    }
    exits[n] = traceRay<Interpolate>(
      task, pass.columnOf(first + n), pass.rowOf(first + n), GatherFields{ gradients, sums });
  }
}

template <class Interpolate, class Real>
void launch(const RayTask<Real>& task, const Pass& pass, std::int64_t first, std::int64_t count,
  RayExit* exits, const FieldGradientsView& gradients, float* gathered)
{
  const auto blocks = static_cast<unsigned>((count + threadsPerBlock - 1) / threadsPerBlock);
  if (gradients.count == 0)
  {
    traceKernel<Interpolate><<<blocks, threadsPerBlock>>>(task, pass, first, count, exits);
  }
  else
  {
    traceAndGatherKernel<Interpolate>
      <<<blocks, threadsPerBlock>>>(task, pass, first, count, exits, gradients, gathered);
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
bool CudaTracer<Real>::trace(const RayTask<Real>& task, Interpolation interpolation,
  const Pass& pass, const FieldGradientsView& gradients, std::uint64_t version, TracedPass& traced,
  const Monitor& monitor)
{
  RayTask<Real> onDevice = task;
  onDevice.medium.samples = memory_->samples.data();
  onDevice.medium.solid = memory_->solid ? memory_->solid->data() : nullptr;
  FieldGradientsView gradientsOnDevice = gradients;
  float* sums = memory_->bring(gradientsOnDevice, version);

  const std::int64_t rays = pass.columns * pass.rows;
  for (std::int64_t first = 0; first < rays; first += raysPerLaunch)
  {
    const std::int64_t count = std::min(raysPerLaunch, rays - first);
    if (interpolation == Interpolation::Quadratic)
    {
      launch<QuadraticInterpolation>(
        onDevice, pass, first, count, memory_->exits.data(), gradientsOnDevice, sums);
    }
    else
    {
      launch<LinearInterpolation>(
        onDevice, pass, first, count, memory_->exits.data(), gradientsOnDevice, sums);
    }
    checkCuda<DeviceError>(cudaGetLastError(), "Starting the ray kernel");
    checkCuda<DeviceError>(
      cudaMemcpy(traced.exits.data() + first, memory_->exits.data(),
        static_cast<std::size_t>(count) * sizeof(RayExit), cudaMemcpyDeviceToHost),
      "Tracing rays");
    if (gradients.count > 0)
    {
      checkCuda<DeviceError>(cudaMemcpy(traced.gathered.data() + first * gradients.count, sums,
                               static_cast<std::size_t>(count * gradients.count) * sizeof(float),
                               cudaMemcpyDeviceToHost),
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
