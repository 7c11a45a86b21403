// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The kernels of CudaFilm.cu: rays are shaded, then the light between them is deposited.

#include "Film/CentreValues.h"
#include "Film/Exposure.h"
#include "Film/RayBox.h"
#include "Film/Sheet.h"

#include <cuda_runtime.h>

#include <cstdint>

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
  PixelRays* pixels;
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

/// What one thread adds. As Sheet wants it.
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
  __device__ void block(
    int plane, std::int64_t column, std::int64_t row, const Contributions& contributions)
  {
    anywhere(plane, column, row, contributions.lowerLeft);
    anywhere(plane, column + 1, row, contributions.lowerRight);
    anywhere(plane, column, row + 1, contributions.upperLeft);
    anywhere(plane, column + 1, row + 1, contributions.upperRight);
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

template <int planes, bool isOfPhase>
using DeviceSheet = Sheet<planes, DeviceDeposit<planes>, 1, isOfPhase>;

__device__ std::int64_t sumOverWarp(std::int64_t number)
{
  constexpr unsigned all = 0xffffffff;
  for (int lanes = 16; lanes > 0; lanes /= 2)
  {
    number += __shfl_down_sync(all, number, lanes);
  }
  return number;
}

/// A pass with the rays of the image and its margin, some rows of which are shaded at a time.
struct RaysOnDevice
{
  const RayExit* exits;
  Pass pass;
  std::int64_t margin;
  std::int64_t columns, rows;    ///< the margin among them
  std::int64_t firstRow, endRow; ///< that are added; cells belong to the row of their lower rays
  std::int64_t firstShaded, endShaded; ///< rows that this takes

  __device__ const RayExit& exit(std::int64_t column, std::int64_t row) const
  {
    return exits[(row - margin - pass.firstRow) * pass.columns + column - margin -
      pass.firstColumn];
  }
  unsigned blocks(std::int64_t rowCount) const
  {
    return static_cast<unsigned>(
      (columns + tileColumns - 1) / tileColumns * ((rowCount + tileRows - 1) / tileRows));
  }
  /// Where the ray, and the cell that it is the lower left one of, is that this thread works for, if the first block
  /// works for row `first`; it may be outside.
  __device__ void place(std::int64_t first, std::int64_t& column, std::int64_t& row) const
  {
    const std::int64_t along = (columns + tileColumns - 1) / tileColumns;
    column = blockIdx.x % along * tileColumns + threadIdx.x % tileColumns;
    row = first + blockIdx.x / along * tileRows + threadIdx.x / tileColumns;
  }
};

/// Shaded rays, and the cells between them that are added by bentKernel.
template <int planes>
struct ShadedRays
{
  RaysOnDevice rays;
  FilmRay<planes>* shaded; ///< rows firstShaded ... endShaded - 1
  unsigned* bent;          ///< first how many, then which: numbers of their lower left rays

  /// Reads a ray, one that does not arrive where there is none.
  __device__ FilmRay<planes> at(std::int64_t column, std::int64_t row) const
  {
    return column >= 0 && column < rays.columns && row >= rays.firstShaded && row < rays.endShaded
      ? shaded[(row - rays.firstShaded) * rays.columns + column]
      : FilmRay<planes>{};
  }
  /// Calls use(the rays of a cell, the rays around it).
  template <bool isOfPhase, class Use>
  __device__ void useCell(std::int64_t column, std::int64_t row, const Use& use) const
  {
    const auto ray = [&](std::int64_t right, std::int64_t up)
    { return at(column + right, row + up); };
    const auto smooth = [&ray](std::int64_t right, std::int64_t up)
    {
      return sheetRay<isOfPhase>(ray(right, up), ray(right - 1, up), ray(right + 1, up),
        ray(right, up - 1), ray(right, up + 1));
    };
    use(smooth(0, 0), smooth(1, 0), smooth(0, 1), smooth(1, 1), ray);
  }
};

/// Turns rays into what the film gets of them, and sums up what is known of each without the others. All threads of a
/// block come to its end.
template <class CutoffKind>
__global__ void shadeKernel(const CutoffKind cutoff, const Projection projection,
  const ShadedRays<CutoffKind::channels> to, const Sums sums)
{
  const RaysOnDevice& rays = to.rays;
  std::int64_t i, j;
  rays.place(rays.firstShaded, i, j);
  RayCounts counts;
  if (i < rays.columns && j < rays.endShaded)
  {
    const RayExit& exit = rays.exit(i, j);
    const std::int64_t column = i - rays.margin, row = j - rays.margin;
    if (j >= rays.firstRow && j < rays.endRow) // others are counted with their own
    {
      counts.add(exit);
      if (column >= 0 && column < sums.film.columns && row >= 0 && row < sums.film.rows)
      {
        // No other thread has this pixel.
        sums.pixels[row * sums.film.columns + column].add(exit, projection.pupilTilt > 0);
        counts.addShaded(exit, cutoff);
      }
    }
    // Rounded as on the CPU.
    const double startColumn = static_cast<double>(-rays.margin) + rays.pass.offset.column;
    const double startRow = static_cast<double>(row) + rays.pass.offset.row;
    to.shaded[(j - rays.firstShaded) * rays.columns + i] = shade(
      exit, startColumn + static_cast<double>(i), startRow, rays.pass.tilt, projection, cutoff);
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

/// Adds the light that threads have emitted. All threads of a block come to its end.
template <int planes>
__device__ void addSums(const DeviceDeposit<planes>& deposit)
{
  for (int plane = 0; plane < planes; ++plane)
  {
    const std::int64_t emitted = sumOverWarp(deposit.all[plane].emitted);
    const std::int64_t outside = sumOverWarp(deposit.all[plane].outside);
    if (threadIdx.x % 32 == 0)
    {
      add(&deposit.sums.planes[plane].emitted, emitted);
      add(&deposit.sums.planes[plane].outside, outside);
    }
  }
}

/// Deposits the light of plain cells on the film. All threads of a block come to its end.
template <int planes, bool isOfPhase>
__global__ void depositKernel(const ShadedRays<planes> from, const Sums sums)
{
  const RaysOnDevice& rays = from.rays;
  std::int64_t i, j;
  rays.place(rays.firstRow, i, j);
  DeviceDeposit<planes> deposit{ sums };
  if (i + 1 < rays.columns && j < rays.endRow && j + 1 < rays.rows)
  {
    from.template useCell<isOfPhase>(i, j,
      [&](const auto& lowerLeft, const auto& lowerRight, const auto& upperLeft,
        const auto& upperRight, const auto&)
      {
        if (!DeviceSheet<planes, isOfPhase>(sums.film, deposit)
               .addPlain(lowerLeft, lowerRight, upperLeft, upperRight))
        {
          const unsigned n = atomicAdd(from.bent, 1u);
          from.bent[1 + n] = static_cast<unsigned>((j - rays.firstRow) * rays.columns + i);
        }
      });
  }
  addSums(deposit);
}

/// Deposits the light of single rays on the film. All threads of a block come to its end.
template <int planes, bool isOfPhase>
__global__ void boxKernel(const ShadedRays<planes> from, const Sums sums)
{
  const RaysOnDevice& rays = from.rays;
  std::int64_t i, j;
  rays.place(rays.firstRow, i, j);
  DeviceDeposit<planes> deposit{ sums };
  if (i < rays.columns && j < rays.endRow)
  {
    RayBox<planes, DeviceDeposit<planes>, 1, isOfPhase>(sums.film, deposit)
      .add(from.at(i, j), from.at(i - 1, j), from.at(i + 1, j), from.at(i, j - 1),
        from.at(i, j + 1), rays.pass.side);
  }
  addSums(deposit);
}

/// The light of other cells, a thread for each part of them. All threads of a block come to its end.
template <int planes, bool isOfPhase>
__global__ void bentKernel(const ShadedRays<planes> from, const Sums sums)
{
  constexpr unsigned parts = 4;
  const RaysOnDevice& rays = from.rays;
  DeviceDeposit<planes> deposit{ sums };
  for (unsigned n = blockIdx.x * blockDim.x + threadIdx.x; n < parts * from.bent[0];
       n += gridDim.x * blockDim.x)
  {
    const unsigned cell = from.bent[1 + n / parts];
    from.template useCell<isOfPhase>(cell % rays.columns, rays.firstRow + cell / rays.columns,
      [&](const auto& lowerLeft, const auto& lowerRight, const auto& upperLeft,
        const auto& upperRight, const auto& around)
      {
        DeviceSheet<planes, isOfPhase>(sums.film, deposit)
          .addOther(
            static_cast<int>(n % parts), lowerLeft, lowerRight, upperLeft, upperRight, around);
      });
  }
  addSums(deposit);
}

/// Writes what pixels' rays carry into arrays.
__global__ void centresKernel(
  const PixelRays* pixels, const std::int64_t count, const CentreArrays arrays)
{
  const std::int64_t pixel = blockIdx.x * static_cast<std::int64_t>(threadsPerBlock) + threadIdx.x;
  if (pixel < count)
  {
    arrays.set(pixel, pixels[pixel]);
  }
}

} // namespace

} // namespace schlieren
