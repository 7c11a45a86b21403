// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Compiled with -fmad=false (see CMakeLists.txt).
#include "Film/CudaFilm.h"

#include "Device/CudaBuffer.h"
#include "Film/Splat.h"

#include <variant>

namespace schlieren
{

namespace
{

constexpr int threadsPerBlock = 128;

/// What atomicAdd takes; whole numbers wrap, so that the sum's bits are those of signed ones.
using Counter = unsigned long long;

struct Sums
{
  std::int64_t width, height;
  double one;
  Counter* light;
  PixelSums* pixels;
  RayCounts* counts;
};

__device__ void add(std::int64_t* to, std::int64_t number)
{
  static_assert(sizeof(Counter) == sizeof(std::int64_t));
  if (number != 0)
  {
    atomicAdd(reinterpret_cast<Counter*>(to), static_cast<Counter>(number));
  }
}

__device__ void addLight(
  const Sums& sums, std::int64_t column, std::int64_t row, std::int64_t light)
{
  if (light != 0 && column >= 0 && column < sums.width && row >= 0 && row < sums.height)
  {
    atomicAdd(sums.light + row * sums.width + column, static_cast<Counter>(light));
  }
}

__device__ void splat(const Sums& sums, const Footprint& at, double light)
{
  const Shares shares = sharesOf(at, light, sums.one);
  addLight(sums, at.column, at.row, shares.lowerLeft);
  addLight(sums, at.column + 1, at.row, shares.lowerRight);
  addLight(sums, at.column, at.row + 1, shares.upperLeft);
  addLight(sums, at.column + 1, at.row + 1, shares.upperRight);
}

__device__ std::int64_t sumOverWarp(std::int64_t number)
{
  constexpr unsigned all = 0xffffffff;
  for (int lanes = 16; lanes > 0; lanes /= 2)
  {
    number += __shfl_down_sync(all, number, lanes);
  }
  return number;
}

/// One thread per ray of the picture and its margin. All threads of a block come to its end.
template <class CutoffKind>
__global__ void exposeKernel(const CutoffKind cutoff, const Projection projection,
  const RayExit* exits, const Pass pass, std::int64_t margin, const Sums sums)
{
  const std::int64_t columns = sums.width + 2 * margin;
  const std::int64_t rows = sums.height + 2 * margin;
  const std::int64_t n = blockIdx.x * static_cast<std::int64_t>(blockDim.x) + threadIdx.x;
  RayCounts counts;
  if (n < columns * rows)
  {
    const std::int64_t i = n % columns;
    const std::int64_t column = i - margin;
    const std::int64_t row = n / columns - margin;
    const RayExit exit = exits[(row - pass.firstRow) * pass.columns + column - pass.firstColumn];
    counts.add(exit);
    if (column >= 0 && column < sums.width && row >= 0 && row < sums.height)
    {
      sums.pixels[row * sums.width + column].add(exit); // no other thread has this pixel
    }
    // Rounded as in Exposure.cxx.
    const double startColumn = static_cast<double>(-margin) + pass.offset.column;
    const double startRow = static_cast<double>(row) + pass.offset.row;
    const RayAtFilm ray =
      rayAtFilm(exit, startColumn + static_cast<double>(i), startRow, projection);
    const double* at = ray.position;
    if (exit.reachesFilm() && isOnFilm(at[0], at[1], sums.width, sums.height))
    {
      double light[CutoffKind::channels];
      cutoff.shade(ray, light);
      splat(sums, footprintOf(at[0], at[1]), light[0]);
      counts.onFilm = 1;
      counts.saturated = cutoff.saturates(ray) ? 1 : 0;
    }
  }
  const int crossed = __syncthreads_count(counts.crossed != 0);
  const int blocked = __syncthreads_count(counts.blocked != 0);
  const int lost = __syncthreads_count(counts.lost != 0);
  const int onFilm = __syncthreads_count(counts.onFilm != 0);
  const int saturated = __syncthreads_count(counts.saturated != 0);
  const std::int64_t steps = sumOverWarp(counts.steps);
  if (threadIdx.x == 0)
  {
    add(&sums.counts->crossed, crossed);
    add(&sums.counts->blocked, blocked);
    add(&sums.counts->lost, lost);
    add(&sums.counts->onFilm, onFilm);
    add(&sums.counts->saturated, saturated);
  }
  if (threadIdx.x % 32 == 0)
  {
    add(&sums.counts->steps, steps);
  }
}

} // namespace

struct CudaFilm::DeviceMemory
{
  explicit DeviceMemory(const Film& film)
    : pixels(static_cast<std::size_t>(film.width() * film.height()))
    , light(pixels)
    , sums(pixels)
    , counts(1)
    , view{ film.width(), film.height(), film.one(), light.data(), sums.data(), counts.data() }
  {
    // All zero bits are zeros, of all that is summed up here.
    clear(light.data(), pixels * sizeof(Counter));
    clear(sums.data(), pixels * sizeof(PixelSums));
    clear(counts.data(), sizeof(RayCounts));
  }

  static void clear(void* bytes, std::size_t size)
  {
    checkCuda<DeviceError>(cudaMemset(bytes, 0, size), "Clearing the film");
  }

  std::size_t pixels;
  CudaBuffer<Counter, DeviceError> light;
  CudaBuffer<PixelSums, DeviceError> sums;
  CudaBuffer<RayCounts, DeviceError> counts;
  Sums view;
};

CudaFilm::CudaFilm(const Film& film)
  : memory_(std::make_unique<DeviceMemory>(film))
{
}

CudaFilm::~CudaFilm() = default;

void CudaFilm::expose(const CudaPass& traced, const Pass& pass, const Cutoffs& cutoff,
  const Projection& projection, std::int64_t margin)
{
  const Sums& sums = memory_->view;
  const std::int64_t rays = (sums.width + 2 * margin) * (sums.height + 2 * margin);
  const auto blocks = static_cast<unsigned>((rays + threadsPerBlock - 1) / threadsPerBlock);
  std::visit(
    [&](const auto& kind)
    {
      exposeKernel<<<blocks, threadsPerBlock>>>(
        kind, projection, traced.exits(), pass, margin, sums);
    },
    cutoff);
  checkCuda<DeviceError>(cudaGetLastError(), "Starting the film's kernel");
}

RayCounts CudaFilm::develop(Film& film, PixelMeans& means) const
{
  const auto fetch = [](void* to, const void* from, std::size_t bytes)
  {
    checkCuda<DeviceError>(
      cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost), "Fetching the picture");
  };
  std::vector<std::int64_t> light(memory_->pixels);
  fetch(light.data(), memory_->light.data(), light.size() * sizeof(std::int64_t));
  film.setLight(std::move(light));
  std::vector<PixelSums> sums(memory_->pixels);
  fetch(sums.data(), memory_->sums.data(), sums.size() * sizeof(PixelSums));
  means.setSums(std::move(sums));
  RayCounts counts;
  fetch(&counts, memory_->counts.data(), sizeof(counts));
  return counts;
}

} // namespace schlieren
