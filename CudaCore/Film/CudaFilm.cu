// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Compiled with -fmad=false (see CMakeLists.txt).
#include "Film/CudaFilm.h"

#include "Device/CudaBuffer.h"
#include "Device/CudaLaunch.h"
#include "Film/Sheet.h"

#include <type_traits>
#include <utility>
#include <variant>

namespace schlieren
{

namespace
{

// A block works for a tile of rays that start near each other.
constexpr int tileColumns = 32, tileRows = 4;
constexpr int threadsPerBlock = tileColumns * tileRows;

/// What atomicAdd takes; whole numbers wrap, so that the sum's bits are those of signed ones.
using Counter = unsigned long long;

struct Sums
{
  FilmSize film;
  Counter* light; ///< plane by plane
  PixelSums* pixels;
  RayCounts* counts;
  LightSums* planes;
};

__device__ void add(std::int64_t* to, std::int64_t number)
{
  static_assert(sizeof(Counter) == sizeof(std::int64_t));
  if (number != 0)
  {
    atomicAdd(reinterpret_cast<Counter*>(to), static_cast<Counter>(number));
  }
}

/// What one thread adds. As Sheet and addPhoton want it.
template <int planes>
struct DeviceDeposit
{
  const Sums& sums;
  LightSums all[planes]{};

  __device__ void emitted(int plane, std::int64_t light) { all[plane].emitted += light; }
  __device__ void outside(int plane, std::int64_t light) { all[plane].outside += light; }
  __device__ void pixel(int plane, std::int64_t column, std::int64_t row, std::int64_t light)
  {
    if (light != 0)
    {
      atomicAdd(sums.light + (plane * sums.film.rows + row) * sums.film.columns + column,
        static_cast<Counter>(light));
    }
  }
  __device__ void block(int plane, std::int64_t column, std::int64_t row, const Shares& shares)
  {
    anywhere(plane, column, row, shares.lowerLeft);
    anywhere(plane, column + 1, row, shares.lowerRight);
    anywhere(plane, column, row + 1, shares.upperLeft);
    anywhere(plane, column + 1, row + 1, shares.upperRight);
  }

private:
  __device__ void anywhere(int plane, std::int64_t column, std::int64_t row, std::int64_t light)
  {
    if (column >= 0 && column < sums.film.columns && row >= 0 && row < sums.film.rows)
    {
      pixel(plane, column, row, light);
    }
    else
    {
      outside(plane, light);
    }
  }
};

__device__ std::int64_t sumOverWarp(std::int64_t number)
{
  constexpr unsigned all = 0xffffffff;
  for (int lanes = 16; lanes > 0; lanes /= 2)
  {
    number += __shfl_down_sync(all, number, lanes);
  }
  return number;
}

/// A pass with the rays of the picture and its margin.
struct RaysOnDevice
{
  const RayExit* exits;
  Pass pass;
  std::int64_t margin;
  std::int64_t columns, rows; ///< the margin among them

  __device__ const RayExit& exit(std::int64_t column, std::int64_t row) const
  {
    return exits[(row - margin - pass.firstRow) * pass.columns + column - margin -
      pass.firstColumn];
  }
  unsigned blocks() const
  {
    return static_cast<unsigned>(
      (columns + tileColumns - 1) / tileColumns * ((rows + tileRows - 1) / tileRows));
  }
  /// Where the ray, and the cell that it is the lower left one of, is that this thread works for; it may be outside.
  __device__ void place(std::int64_t& column, std::int64_t& row) const
  {
    const std::int64_t along = (columns + tileColumns - 1) / tileColumns;
    column = blockIdx.x % along * tileColumns + threadIdx.x % tileColumns;
    row = blockIdx.x / along * tileRows + threadIdx.x / tileColumns;
  }
};

/// Turns rays into what the film gets of them, and sums up what is known of each without the others. All threads of a
/// block come to its end.
template <class CutoffKind>
__global__ void shadeKernel(const CutoffKind cutoff, const Projection projection,
  const RaysOnDevice rays, FilmRay<CutoffKind::channels>* shaded, const Sums sums)
{
  std::int64_t i, j;
  rays.place(i, j);
  RayCounts counts;
  if (i < rays.columns && j < rays.rows)
  {
    const RayExit& exit = rays.exit(i, j);
    counts.add(exit);
    const std::int64_t column = i - rays.margin, row = j - rays.margin;
    if (column >= 0 && column < sums.film.columns && row >= 0 && row < sums.film.rows)
    {
      sums.pixels[row * sums.film.columns + column].add(exit); // no other thread has this pixel
      counts.addShaded(exit, cutoff);
    }
    FilmRay<CutoffKind::channels> ray{};
    ray.arrives = exit.reachesFilm();
    ray.crossed = crossedOnTheWay(exit, projection);
    if (ray.arrives)
    {
      // Rounded as in Exposure.cxx.
      const double startColumn = static_cast<double>(-rays.margin) + rays.pass.offset.column;
      const double startRow = static_cast<double>(row) + rays.pass.offset.row;
      const RayAtFilm atFilm =
        rayAtFilm(exit, startColumn + static_cast<double>(i), startRow, rays.pass.tilt, projection);
      ray.x = atFilm.place[0] + 0.5;
      ray.y = atFilm.place[1] + 0.5;
      cutoff.shade(atFilm, ray.light);
    }
    shaded[j * rays.columns + i] = ray;
  }
  const int crossed = __syncthreads_count(counts.crossed != 0);
  const int blocked = __syncthreads_count(counts.blocked != 0);
  const int lost = __syncthreads_count(counts.lost != 0);
  const int bright = __syncthreads_count(counts.shaded != 0);
  const int saturated = __syncthreads_count(counts.saturated != 0);
  const std::int64_t steps = sumOverWarp(counts.steps);
  if (threadIdx.x == 0)
  {
    add(&sums.counts->crossed, crossed);
    add(&sums.counts->blocked, blocked);
    add(&sums.counts->lost, lost);
    add(&sums.counts->shaded, bright);
    add(&sums.counts->saturated, saturated);
  }
  if (threadIdx.x % 32 == 0)
  {
    add(&sums.counts->steps, steps);
  }
}

/// Brings the light of shaded rays to the film. All threads of a block come to its end.
template <FilmEstimator estimator, int planes>
__global__ void depositKernel(
  const RaysOnDevice rays, const FilmRay<planes>* shaded, const Sums sums)
{
  std::int64_t i, j;
  rays.place(i, j);
  DeviceDeposit<planes> deposit{ sums };
  if (i < rays.columns && j < rays.rows)
  {
    const auto ray = [&](std::int64_t right, std::int64_t up)
    {
      const std::int64_t column = i + right, row = j + up;
      return column >= 0 && column < rays.columns && row >= 0 && row < rays.rows
        ? shaded[row * rays.columns + column]
        : FilmRay<planes>{};
    };
    if constexpr (estimator == FilmEstimator::Photon)
    {
      addPhoton(ray(0, 0), sums.film, deposit);
    }
    else if (i + 1 < rays.columns && j + 1 < rays.rows)
    {
      const auto smooth = [&ray](std::int64_t right, std::int64_t up)
      {
        return sheetRay(ray(right, up), ray(right - 1, up), ray(right + 1, up), ray(right, up - 1),
          ray(right, up + 1));
      };
      Sheet<planes, DeviceDeposit<planes>>(sums.film, deposit)
        .addCell(smooth(0, 0), smooth(1, 0), smooth(0, 1), smooth(1, 1), ray);
    }
  }
  for (int plane = 0; plane < planes; ++plane)
  {
    const std::int64_t emitted = sumOverWarp(deposit.all[plane].emitted);
    const std::int64_t outside = sumOverWarp(deposit.all[plane].outside);
    if (threadIdx.x % 32 == 0)
    {
      add(&sums.planes[plane].emitted, emitted);
      add(&sums.planes[plane].outside, outside);
    }
  }
}

} // namespace

struct CudaFilm::DeviceMemory
{
  explicit DeviceMemory(const Films& films)
    : pixels(films.planes[0].pixels())
    , light(pixels * films.planes.size())
    , sums(pixels)
    , counts(1)
    , planes(films.planes.size())
    , view{ { films.planes[0].width(), films.planes[0].height(), films.planes[0].one() },
      light.data(), sums.data(), counts.data(), planes.data() }
  {
    // All zero bits are zeros, of all that is summed up here.
    clear(light.data(), pixels * films.planes.size() * sizeof(Counter));
    clear(sums.data(), pixels * sizeof(PixelSums));
    clear(counts.data(), sizeof(RayCounts));
    clear(planes.data(), films.planes.size() * sizeof(LightSums));
    if (films.samples)
    {
      samples = std::make_unique<CudaFilm>(*films.samples);
    }
  }

  /// A table's copy on the device, as long as none is asked for that lies elsewhere.
  Table copyOf(const Table& table)
  {
    if (!copied || onHost != table.values)
    {
      copied = std::make_unique<CudaBuffer<float, DeviceError>>(
        table.values, table.size, "Copying the cutoff");
      onHost = table.values;
    }
    return { copied->data(), table.size };
  }

  /// Room for shaded rays, which serves again.
  template <int planes>
  FilmRay<planes>* raysAtFilm(std::int64_t count)
  {
    const auto bytes = static_cast<std::size_t>(count) * sizeof(FilmRay<planes>);
    if (!shaded || shadedBytes < bytes)
    {
      shaded.reset();
      shaded = std::make_unique<CudaBuffer<unsigned char, DeviceError>>(bytes);
      shadedBytes = bytes;
    }
    return reinterpret_cast<FilmRay<planes>*>(shaded->data());
  }

  static void clear(void* bytes, std::size_t size)
  {
    checkCuda<DeviceError>(cudaMemset(bytes, 0, size), "Clearing the film");
  }

  std::size_t pixels;
  CudaBuffer<Counter, DeviceError> light;
  CudaBuffer<PixelSums, DeviceError> sums;
  CudaBuffer<RayCounts, DeviceError> counts;
  CudaBuffer<LightSums, DeviceError> planes;
  Sums view;
  std::unique_ptr<CudaFilm> samples;
  std::unique_ptr<CudaBuffer<float, DeviceError>> copied;
  const float* onHost = nullptr; ///< what has been copied
  std::unique_ptr<CudaBuffer<unsigned char, DeviceError>> shaded;
  std::size_t shadedBytes = 0;
};

CudaFilm::CudaFilm(const Films& films)
  : memory_(std::make_unique<DeviceMemory>(films))
{
}

CudaFilm::~CudaFilm() = default;

void CudaFilm::expose(const CudaPass& traced, const Pass& pass, const Cutoffs& cutoff,
  const Projection& projection, std::int64_t margin, FilmEstimator estimator)
{
  const Sums& sums = memory_->view;
  const RaysOnDevice rays{ traced.exits(), pass, margin, sums.film.columns + 2 * margin,
    sums.film.rows + 2 * margin };
  std::visit(
    [&](auto kind)
    {
      using Kind = decltype(kind);
      constexpr int planes = Kind::channels;
      if (Table* table = tableOf(kind))
      {
        *table = memory_->copyOf(*table);
      }
      auto* const shaded = memory_->raysAtFilm<planes>(rays.columns * rays.rows);
      launchKernel(shadeKernel<Kind>, rays.blocks(), threadsPerBlock, 0, nullptr, kind, projection,
        rays, shaded, sums);
      launchKernel(estimator == FilmEstimator::Sheet ? depositKernel<FilmEstimator::Sheet, planes>
                                                     : depositKernel<FilmEstimator::Photon, planes>,
        rays.blocks(), threadsPerBlock, 0, nullptr, rays, shaded, sums);
    },
    cutoff);
  checkCuda<DeviceError>(cudaGetLastError(), "Starting the film's kernel");
  if (memory_->samples)
  {
    memory_->samples->expose(traced, pass, Shadowgraph{}, projection, margin, estimator);
  }
}

RayCounts CudaFilm::develop(Films& films, PixelMeans& means) const
{
  const auto fetch = [](void* to, const void* from, std::size_t bytes)
  {
    checkCuda<DeviceError>(
      cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost), "Fetching the picture");
  };
  if (memory_->samples)
  {
    memory_->samples->develop(*films.samples, means); // overwritten below
  }
  for (std::size_t plane = 0; plane < films.planes.size(); ++plane)
  {
    std::vector<std::int64_t> light(memory_->pixels);
    LightSums all;
    fetch(light.data(), memory_->light.data() + plane * memory_->pixels,
      light.size() * sizeof(std::int64_t));
    fetch(&all, memory_->planes.data() + plane, sizeof(all));
    films.planes[plane].set(std::move(light), all);
  }
  std::vector<PixelSums> sums(memory_->pixels);
  fetch(sums.data(), memory_->sums.data(), sums.size() * sizeof(PixelSums));
  means.setSums(std::move(sums));
  RayCounts counts;
  fetch(&counts, memory_->counts.data(), sizeof(counts));
  return counts;
}

} // namespace schlieren
