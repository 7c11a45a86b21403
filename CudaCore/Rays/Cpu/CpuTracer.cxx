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

/// Calls use(ray of its pass) for the rays of a tile, block by block.
template <int Lanes, class Use>
void forEachOfBlocks(const TileOfPass& tile, const Use& use)
{
  constexpr int columns = Block<Lanes>::columns, rows = Block<Lanes>::rows;
  for (std::int64_t low = 0; low < tile.rows; low += rows)
  {
    for (std::int64_t left = 0; left < tile.columns; left += columns)
    {
      for (std::int64_t row = low; row < std::min(low + rows, tile.rows); ++row)
      {
        for (std::int64_t column = left; column < std::min(left + columns, tile.columns); ++column)
        {
          use((tile.low + row) * tile.of.pass.columns + tile.left + column);
        }
      }
    }
  }
}

template <class Number, int Lanes>
std::int64_t traceTilesWith(const RayTask<Number>& task, MarchFunction<Number, Lanes> marchBatches,
  const Passes& passes, const Tiles& tiles, TracedPass& traced, int threads, const Monitor& monitor)
{
  struct OfPiece
  {
    double worstDrift = 0;
    std::int64_t crossed = 0;
  };
  // Small tiles are taken together, so that rays of several fill a batch.
  const std::int64_t grain = std::max<std::int64_t>(1,
    tileEdge * tileEdge * passes.tiles() /
      (2 * static_cast<std::int64_t>(std::max<std::size_t>(1, passes.rays()))));
  std::vector<OfPiece> ofPieces(static_cast<std::size_t>((tiles.count() + grain - 1) / grain));

  // Numbers as of all tiles, for the progress.
  const std::int64_t before = tiles.first / tiles.step;
  const std::int64_t done = parallelFrom(
    before, before + tiles.count(), grain, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      OfPiece& here = ofPieces[static_cast<std::size_t>((begin - before) / grain)];
      RayBatch<Number, Lanes> batches[2]{};
      Entry entries[2 * Lanes]{};
      std::int64_t rays[2 * Lanes];
      int taken = 0;
      const auto marchTaken = [&]
      {
        for (int i = taken; i < 2 * Lanes; ++i)
        {
          batches[i / Lanes].fate[i % Lanes] = RayFate::Missed;
        }
        marchBatches(task, batches[0], batches[1]);
        for (int i = 0; i < taken; ++i)
        {
          const RayBatch<Number, Lanes>& batch = batches[i / Lanes];
          const int lane = i % Lanes;
          traced.exits[static_cast<std::size_t>(rays[i])] =
            leaveGrid(task, batch, lane, entries[i]);
          here.worstDrift = std::max(here.worstDrift, static_cast<double>(batch.drift[lane]));
          here.crossed += batch.fate[lane] != RayFate::Missed ? 1 : 0;
        }
        batches[0] = batches[1] = {};
        taken = 0;
      };
      for (std::int64_t number = begin; number < end; ++number)
      {
        const TileOfPass tile = passes.tile(tiles.first + (number - before) * tiles.step);
        const Pass& pass = tile.of.pass;
        forEachOfBlocks<Lanes>(tile,
          [&](std::int64_t ray)
          {
            rays[taken] = tile.of.firstRay + ray;
            entries[taken] = enterGrid(task, pass, ray, batches[taken / Lanes], taken % Lanes);
            if (++taken == 2 * Lanes)
            {
              marchTaken();
            }
          });
      }
      if (taken > 0)
      {
        marchTaken();
      }
    },
    monitor);
  for (const OfPiece& piece : ofPieces)
  {
    traced.worstDrift = std::max(traced.worstDrift, piece.worstDrift);
    traced.crossed += piece.crossed;
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
