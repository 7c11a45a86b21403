// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/Cpu/CpuTracer.h"

#include "Device/Parallel.h"
#include "Rays/Cpu/SimdMarch.h"
#include "Rays/Cpu/SimdUnits.h"
#include "Rays/March/Kernels.h"
#include "Rays/March/OneRay.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <type_traits>

namespace schlieren
{

namespace
{

std::atomic<std::int64_t> tilesSoFar{ 0 };

/// One ray, or a rectangle of pixels whose rays a kernel takes side by side: near each other, they look at
/// the same samples of the medium.
template <int Lanes>
struct Block
{
  static constexpr int columns = Lanes == 16 || Lanes == 8 ? 4 : Lanes == 4 ? 2 : 1;
  static constexpr int rows = Lanes / columns;
};

template <class Number, int Lanes>
std::int64_t traceTilesWith(const RayTask<Number>& task, MarchFunction<Number, Lanes> marchBatches,
  const Passes& passes, const Tiles& tiles, TracedPass& traced, int threads, const Monitor& monitor)
{
  struct OfTile
  {
    double worstDrift = 0;
    std::int64_t crossed = 0;
  };
  std::vector<OfTile> ofTiles(static_cast<std::size_t>(tiles.count()));

  const auto enterBlock = [&](const PlacedPass& of, std::int64_t column, std::int64_t row,
                            RayBatch<Number, Lanes>& batch, Entry(&entries)[Lanes],
                            std::int64_t(&rays)[Lanes])
  {
    const Pass& pass = of.pass;
    for (int i = 0; i < Lanes; ++i)
    {
      const std::int64_t atColumn = column + i % Block<Lanes>::columns;
      const std::int64_t atRow = row + i / Block<Lanes>::columns;
      rays[i] = -1;
      batch.fate[i] = RayFate::Missed;
      if (atColumn < pass.columns && atRow < pass.rows)
      {
        const std::int64_t ray = atRow * pass.columns + atColumn;
        entries[i] = enterGrid(task, pass, ray, batch, i);
        rays[i] = of.firstRay + ray;
      }
    }
  };
  const auto leaveBlock = [&](const RayBatch<Number, Lanes>& batch, const Entry(&entries)[Lanes],
                            const std::int64_t(&rays)[Lanes], OfTile& tile)
  {
    for (int i = 0; i < Lanes; ++i)
    {
      if (rays[i] >= 0)
      {
        traced.exits[static_cast<std::size_t>(rays[i])] = leaveGrid(task, batch, i, entries[i]);
        tile.worstDrift = std::max(tile.worstDrift, static_cast<double>(batch.drift[i]));
        tile.crossed += batch.fate[i] != RayFate::Missed ? 1 : 0;
      }
    }
  };

  // Numbers as of all tiles, for the progress.
  const std::int64_t before = tiles.first / tiles.step;
  const std::int64_t done = parallelFrom(
    before, before + tiles.count(), 1, threads,
    [&](std::int64_t number, std::int64_t)
    {
      const TileOfPass tile = passes.tile(tiles.first + (number - before) * tiles.step);
      for (std::int64_t row = tile.low; row < tile.low + tile.rows; row += Block<Lanes>::rows)
      {
        for (std::int64_t column = tile.left; column < tile.left + tile.columns;
             column += 2 * Block<Lanes>::columns)
        {
          RayBatch<Number, Lanes> batches[2]{};
          Entry entries[2][Lanes]{};
          std::int64_t rays[2][Lanes];
          enterBlock(tile.of, column, row, batches[0], entries[0], rays[0]);
          enterBlock(tile.of, column + Block<Lanes>::columns, row, batches[1], entries[1], rays[1]);
          marchBatches(task, batches[0], batches[1]);
          OfTile& here = ofTiles[static_cast<std::size_t>(number - before)];
          leaveBlock(batches[0], entries[0], rays[0], here);
          leaveBlock(batches[1], entries[1], rays[1], here);
        }
      }
    },
    monitor);
  for (const OfTile& tile : ofTiles)
  {
    traced.worstDrift = std::max(traced.worstDrift, tile.worstDrift);
    traced.crossed += tile.crossed;
  }
  return done - before;
}

template <class Number>
MarchFunction<Number, 1> marchOneByOne(const KernelChoice& choice)
{
  return visitKernel(choice,
    [](auto kernel) -> MarchFunction<Number, 1>
    {
      using Kind = decltype(kernel);
      return [](const RayTask<Number>& task, RayBatch<Number, 1>& one, RayBatch<Number, 1>& other)
      {
        march<Kind, Number>(task, one);
        march<Kind, Number>(task, other);
      };
    });
}

} // namespace

bool hasSimd(Simd simd)
{
  if (!isCompiledFor(simd))
  {
    return false;
  }
#ifdef __x86_64__
  if (simd == Simd::Avx512)
  {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("fma");
  }
  if (simd == Simd::Avx2)
  {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  }
#endif
  return true;
}

Simd bestSimd()
{
  return hasSimd(Simd::Avx512) ? Simd::Avx512 : hasSimd(Simd::Avx2) ? Simd::Avx2 : Simd::Four;
}

template <class Real>
bool traceOnCpu(const RayTask<Real>& task, const Passes& passes, TracedPass& traced, int threads,
  const Monitor& monitor, Simd simd)
{
  const std::int64_t all = passes.tiles();
  traced.begin();
  traced.tilesDone +=
    traceTiles(task, passes, { traced.tilesDone, all }, traced, threads, monitor, simd);
  const bool isFinished = traced.tilesDone == all;
  traced.tilesDone = isFinished ? 0 : traced.tilesDone;
  return isFinished;
}

template <class Real>
std::int64_t traceTiles(const RayTask<Real>& task, const Passes& passes, const Tiles& tiles,
  TracedPass& traced, int threads, const Monitor& monitor, Simd simd)
{
  const KernelChoice& kernel = task.kernel;
  tilesSoFar += tiles.count();
  if (task.medium.planeStride > std::numeric_limits<std::uint32_t>::max())
  {
    simd = Simd::None; // the others multiply strides of 32 bits
  }
  const auto traceWith = [&](auto marchBatches)
  { return traceTilesWith(task, marchBatches, passes, tiles, traced, threads, monitor); };
  constexpr bool isSingle = std::is_same_v<Real, float>;
  constexpr int ofAvx512 = isSingle ? 16 : 8, ofAvx2 = isSingle ? 8 : 4;
  if constexpr (isCompiledFor(Simd::Avx512))
  {
    if (simd == Simd::Avx512)
    {
      return traceWith(simdMarch<Real, ofAvx512>(kernel));
    }
  }
  if constexpr (isCompiledFor(Simd::Avx2))
  {
    if (simd == Simd::Avx2)
    {
      return traceWith(simdMarch<Real, ofAvx2>(kernel));
    }
  }
  if constexpr (isSingle) // for doubles the instructions that all have are too narrow to gain
  {
    if (simd != Simd::None)
    {
      return traceWith(simdMarch<Real, 4>(kernel));
    }
  }
  return traceWith(marchOneByOne<Real>(kernel));
}

std::int64_t tilesTracedOnCpu() { return tilesSoFar; }

template bool traceOnCpu(
  const RayTask<float>&, const Passes&, TracedPass&, int, const Monitor&, Simd);
template bool traceOnCpu(
  const RayTask<double>&, const Passes&, TracedPass&, int, const Monitor&, Simd);
template std::int64_t traceTiles(
  const RayTask<float>&, const Passes&, const Tiles&, TracedPass&, int, const Monitor&, Simd);
template std::int64_t traceTiles(
  const RayTask<double>&, const Passes&, const Tiles&, TracedPass&, int, const Monitor&, Simd);

} // namespace schlieren
