// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/CudaBuffer.h"
#include "Device/CudaLaunch.h"
#include "Medium/CudaHomogeneityMap.h"

#include <optional>

namespace schlieren
{

namespace
{

constexpr int threadsPerBlock = 128;

__device__ std::int64_t index()
{
  return blockIdx.x * static_cast<std::int64_t>(blockDim.x) + threadIdx.x;
}

template <class Scheme, class Real>
__global__ void brickKernel(
  const MediumView<Real> medium, const BrickPyramid pyramid, NuRange<Real>* ranges)
{
  const std::int64_t n = index();
  if (n < pyramid.size(0))
  {
    ranges[n] = rangeOfBrick<Scheme>(medium, pyramid, n);
  }
}

template <class Real>
__global__ void cubeKernel(const BrickPyramid pyramid, int level, NuRange<Real>* ranges)
{
  const std::int64_t n = index();
  if (n < pyramid.size(level))
  {
    ranges[pyramid.first(level) + n] = rangeOfCube(ranges, pyramid, level, n);
  }
}

template <class Real>
__global__ void levelKernel(
  const NuRange<Real>* ranges, const BrickPyramid pyramid, Real tolerance, std::uint8_t* levels)
{
  const std::int64_t n = index();
  if (n < pyramid.size(0))
  {
    levels[n] = levelOfBrick(ranges, pyramid, tolerance, n);
  }
}

unsigned blocksFor(std::int64_t count)
{
  return static_cast<unsigned>((count + threadsPerBlock - 1) / threadsPerBlock);
}

template <class T>
void copyToHost(std::vector<T>& host, const T* device)
{
  checkCuda(cudaMemcpy(host.data(), device, host.size() * sizeof(T), cudaMemcpyDeviceToHost),
    "Building the homogeneity map");
}

} // namespace

template <class Real>
HomogeneityMap<Real> buildHomogeneityMapOnCuda(
  const Medium<Real>& medium, Interpolation interpolation, Real tolerance)
{
  const BrickPyramid pyramid = pyramidOver(medium.volume.dimensions);
  HomogeneityMap<Real> map{ pyramid,
    std::vector<NuRange<Real>>(static_cast<std::size_t>(pyramid.first(pyramid.levels))),
    std::vector<std::uint8_t>(static_cast<std::size_t>(pyramid.size(0))) };

  const CudaBuffer<Real> samples(
    medium.volume.samples.data(), medium.volume.samples.size(), "Copying the medium");
  MediumView<Real> view = medium.view();
  view.samples = samples.data();
  std::optional<CudaBuffer<std::uint32_t>> solid;
  if (!medium.solid.empty())
  {
    solid.emplace(medium.solid.data(), medium.solid.size(), "Copying the solids");
    view.solid = solid->data();
  }
  const CudaBuffer<NuRange<Real>> ranges(map.ranges.size());
  const CudaBuffer<std::uint8_t> levels(map.levels.size());

  const unsigned blocks = blocksFor(pyramid.size(0));
  visitScheme(interpolation,
    [&](auto scheme)
    {
      launchKernel(brickKernel<decltype(scheme), Real>, blocks, threadsPerBlock, 0, nullptr, view,
        pyramid, ranges.data());
    });
  for (int level = 1; level < pyramid.levels; ++level)
  {
    launchKernel(cubeKernel<Real>, blocksFor(pyramid.size(level)), threadsPerBlock, 0, nullptr,
      pyramid, level, ranges.data());
  }
  launchKernel(levelKernel<Real>, blocks, threadsPerBlock, 0, nullptr, ranges.data(), pyramid,
    tolerance, levels.data());
  checkCuda(cudaGetLastError(), "Starting the homogeneity map's kernels");
  copyToHost(map.ranges, ranges.data());
  copyToHost(map.levels, levels.data());
  return map;
}

template HomogeneityMap<float> buildHomogeneityMapOnCuda(
  const Medium<float>&, Interpolation, float);
template HomogeneityMap<double> buildHomogeneityMapOnCuda(
  const Medium<double>&, Interpolation, double);

} // namespace schlieren
