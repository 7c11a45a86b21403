// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Included by each of the CudaMarch*.cu.
#include "Rays/Cuda/CudaMarch.h"

#include "Device/CudaLaunch.h"
#include "Rays/March/Kernels.h"
#include "Rays/March/OneRay.h"

namespace schlieren
{

/// How many blocks a multiprocessor has at the same time: in single precision their rays' state then takes 96 registers
/// of a thread. Kernels that sample at several places in a step would have to keep it in memory.
template <class Kernel, class Real>
constexpr int blocksAtATime = sizeof(Real) == sizeof(float) && !Kernel::Integrator::samplesBeyond
  ? 5
  : 1;

/// The pixel of a thread: each row of blocks has a band.
struct PixelOfThread
{
  const PlacedPass* of;
  std::int64_t column, row; ///< of its pass

  __device__ explicit PixelOfThread(const MarchedBands& bands)
    : of(bands.passes)
  {
    const std::int64_t band = bands.firstBand + blockIdx.y;
    for (int left = bands.count; left > 1;)
    {
      const int half = left / 2;
      of += of[half].firstBand <= band ? half : 0;
      left -= half;
    }
    const int warp = static_cast<int>(threadIdx.x) / threadsPerWarp;
    const int lane = static_cast<int>(threadIdx.x) % threadsPerWarp;
    column = std::int64_t{ blockIdx.x } * blockColumns + warp % warpsAlong * warpColumns +
      lane % warpColumns;
    row = (band - of->firstBand) * blockRows + warp / warpsAlong * warpRows + lane / warpColumns;
  }
};

/// All threads of a block come here. Adds to a sum how many of them are counted.
__device__ inline void addCount(bool isCounted, unsigned long long* sum)
{
  const int count = __syncthreads_count(isCounted ? 1 : 0);
  if (threadIdx.x == 0 && count > 0)
  {
    atomicAdd(sum, static_cast<unsigned long long>(count));
  }
}

/// All threads of a warp come here.
__device__ inline void addDrift(double worstDrift, long long* worst)
{
  for (int lanes = threadsPerWarp / 2; lanes > 0; lanes /= 2)
  {
    constexpr unsigned all = 0xffffffff;
    worstDrift = fmax(worstDrift, __shfl_down_sync(all, worstDrift, lanes));
  }
  if (threadIdx.x % threadsPerWarp == 0 && worstDrift > 0)
  {
    atomicMax(worst, __double_as_longlong(worstDrift));
  }
}

/// All threads of a block come to its end. The task stays where parameters are: a copy would be in local memory.
template <class Kernel, class May, class Real>
__global__ void __launch_bounds__(threadsPerBlock, blocksAtATime<Kernel, Real>) traceKernel(
  const __grid_constant__ RayTask<Real> task, const __grid_constant__ MarchedBands bands)
{
  const PixelOfThread pixel(bands);
  const Pass& pass = pixel.of->pass;
  bool hasCrossed = false;
  double worstDrift = 0;
  if (pixel.column < pass.columns && pixel.row < pass.rows)
  {
    const std::int64_t inPass = pixel.row * pass.columns + pixel.column;
    const std::int64_t ray = pixel.of->firstRay + inPass;
    Real drift = 0;
    const RayExit exit = traceRay<Kernel, May>(task, pass, inPass, drift);
    bands.exits[ray] = exit;
    hasCrossed = exit.fate != RayFate::Missed;
    worstDrift = drift > 0 ? static_cast<double>(drift) : 0; // not NaN
  }
  addCount(hasCrossed, &bands.totals->crossed);
  addDrift(worstDrift, &bands.totals->worstDrift);
}

template <class Scheme, class Real>
void launchMarch(
  const RayTask<Real>& task, const MarchedBands& bands, const dim3& blocks, cudaStream_t stream)
{
  visitKernelOf<Scheme>(task.kernel,
    [&](auto kind)
    {
      using Kind = decltype(kind);
      launchKernel(task.medium.leaves != nullptr ? traceKernel<Kind, MayMeet<false, true>, Real>
                                                 : traceKernel<Kind, MayMeet<true, false>, Real>,
        blocks, threadsPerBlock, 0, stream, task, bands);
    });
}

} // namespace schlieren
