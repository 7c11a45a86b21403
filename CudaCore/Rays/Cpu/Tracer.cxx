// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/Cpu/Tracer.h"

#include "Device/Parallel.h"
#include "Rays/Cpu/SimdMarch.h"
#include "Rays/Cpu/SimdUnits.h"
#include "Rays/March/Kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace schlieren
{

namespace
{

/// Index coordinates that steps are to be measured in, by the light's unit of length. Where nothing depends on z, only
/// the bending of rays needs steps along it: by one of d, leapfrog takes a ray's deflection wrong by
/// d^2 |nu''| / 6, which shall be a thousandth. |nu''| is no more than twice the steepest gradient by a smallest voxel.
template <class Real>
Vec3<double> scaleOfSteps(const Medium<Real>& medium, const Light& light, PathModel path)
{
  Vec3<double> scale = light.indexScale;
  if (medium.tree == nullptr || medium.tree->shape() == BrickShape::Cube)
  {
    return scale;
  }
  const double perVoxel = std::max(scale.x, scale.y);
  const double finest = std::exp2(medium.tree->statistics().finestLevel);
  constexpr double allowed = 1e-3;
  const double steepest = std::max(medium.slope.x, medium.slope.y) / finest; // nu by voxel
  const double voxelsAlong = std::sqrt(6 * allowed / (2 * steepest));
  scale.z = path == PathModel::Straight ? 0 : perVoxel / std::max(1., voxelsAlong);
  return scale;
}

} // namespace

template <class Real>
RayTask<Real> makeTask(const Medium<Real>& medium, const HomogeneityMap<Real>* map,
  const FieldGradientsView& gradients, const Light& light, const RaySettings& settings)
{
  RayTask<Real> task{};
  task.medium = medium.view();
  if (map != nullptr)
  {
    task.map = map->view();
  }
  if (gradients.count > 0)
  {
    task.gradients = gradients;
  }
  task.light = light;
  task.indexScale = static_cast<Vec3<Real>>(light.indexScale);
  // Beside solids no longer than a voxel, or rays would step through thin ones.
  const double voxels =
    task.medium.solid == nullptr ? settings.stepVoxels : std::min(settings.stepVoxels, 1.);
  const double finest = medium.tree ? std::exp2(medium.tree->statistics().finestLevel) : 1;
  // No longer than it takes to be through all of it with one step, whatever rounding does.
  const double fastest = std::max(light.fastest(scaleOfSteps(medium, light, settings.kernel.path)),
    std::min(settings.stepVoxels, 1.) / (2 * finest * light.depth));
  const double step = voxels / fastest;
  task.step = static_cast<Real>(step);
  task.stepAtEdge = static_cast<Real>(std::min(settings.stepVoxels, 1.) / fastest);
  constexpr double stepsAhead = 4;
  const auto ahead = [&](double along, double scale)
  { return std::llround(stepsAhead * step * along * scale); };
  task.medium.ahead = ahead(light.w.z, light.indexScale.z) * task.medium.planeStride +
    ahead(light.w.y, light.indexScale.y) * task.medium.rowStride +
    ahead(light.w.x, light.indexScale.x);
  const double bend = boundBySteepest(medium, light).bend;
  const double largestQ =
    largestKickAtEntry(medium.largestNu, light) + (std::isfinite(bend) ? bend : 2);
  constexpr double margin = 1.01; // for the integrator's error
  task.largestQ = static_cast<Real>(margin * largestQ);
  const double straightSteps =
    std::ceil(light.depth / light.smallestCosine() / task.stepAtEdge * finest) + 1;
  constexpr double largestLimit = std::numeric_limits<std::int32_t>::max();
  // Where n is small, a step leads less far; and an adaptive one may have to be much shorter.
  constexpr double smallestIndex = 1e-3;
  const double slow = medium.largestNu < 1 ? 1 / std::max(1 - medium.largestNu, smallestIndex) : 1;
  const double shorter = settings.kernel.integrator == Integrator::Adaptive ? adaptiveFactor : 1;
  task.stepLimit = static_cast<std::int32_t>(
    std::min(trappedFactor * straightSteps * slow * shorter, largestLimit));
  task.metresPerUnit = (1 + medium.ambient) * settings.lengthScale * light.unit;
  task.kernel = settings.kernel;
  // By what the steepest gradient would bend a ray over the same length, and no less than what rounding makes.
  const double steepest = length(scaled(medium.slope, light.indexScale));
  const double rounding =
    16 * medium.largestNu * static_cast<double>(std::numeric_limits<Real>::epsilon());
  const double allowed =
    std::max(settings.adaptiveTolerance * (steepest > 0 ? steepest : 1), rounding);
  task.allowedBend = static_cast<Real>(allowed);
  task.allowedOffset = static_cast<Real>(allowed * light.depth);
  return task;
}

namespace
{

/// One ray, or a rectangle of pixels whose rays a kernel takes side by side: near each other, they look at
/// the same part of the medium.
template <int Lanes>
struct Block
{
  static constexpr int columns = Lanes == 16 || Lanes == 8 ? 4 : Lanes == 4 ? 2 : 1;
  static constexpr int rows = Lanes / columns;
};

template <class Number, int Lanes>
std::int64_t traceTilesWith(const RayTask<Number>& task, MarchFunction<Number, Lanes> marchBatches,
  const Pass& pass, const Tiles& tiles, TracedPass& traced, int threads, const Monitor& monitor)
{
  struct OfTile
  {
    double worstDrift = 0;
    std::int64_t crossed = 0;
  };
  std::vector<OfTile> ofTiles(static_cast<std::size_t>(tiles.count()));

  const auto enterBlock = [&](std::int64_t column, std::int64_t row, RayBatch<Number, Lanes>& batch,
                            Entry(&entries)[Lanes], std::int64_t(&rays)[Lanes])
  {
    for (int i = 0; i < Lanes; ++i)
    {
      const std::int64_t atColumn = column + i % Block<Lanes>::columns;
      const std::int64_t atRow = row + i / Block<Lanes>::columns;
      rays[i] = -1;
      batch.fate[i] = RayFate::Missed;
      if (atColumn < pass.columns && atRow < pass.rows)
      {
        rays[i] = atRow * pass.columns + atColumn;
        entries[i] = enterGrid(task, pass, rays[i], batch, i);
        batch.gathered[i] = traced.gathered.data() + rays[i] * task.gradients.count;
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

  // Numbers as of all tiles of the pass, for the progress.
  const std::int64_t before = tiles.first / tiles.step;
  const std::int64_t done = parallelFrom(
    before, before + tiles.count(), 1, threads,
    [&](std::int64_t number, std::int64_t)
    {
      const std::int64_t tile = tiles.first + (number - before) * tiles.step;
      const std::int64_t left = tile % tilesAlong(pass) * tileEdge;
      const std::int64_t low = tile / tilesAlong(pass) * tileEdge;
      for (std::int64_t row = low; row < std::min(low + tileEdge, pass.rows);
           row += Block<Lanes>::rows)
      {
        for (std::int64_t column = left; column < std::min(left + tileEdge, pass.columns);
             column += 2 * Block<Lanes>::columns)
        {
          RayBatch<Number, Lanes> batches[2]{};
          Entry entries[2][Lanes]{};
          std::int64_t rays[2][Lanes];
          enterBlock(column, row, batches[0], entries[0], rays[0]);
          enterBlock(column + Block<Lanes>::columns, row, batches[1], entries[1], rays[1]);
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
  if (simd >= Simd::Avx512)
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
#ifdef __x86_64__
  // A gather takes one load for each number on Intel's processors, and several times that on others. By the vendor and
  // not by a measurement, so that images do not depend on what else a machine does.
  const Simd best = __builtin_cpu_is("intel") ? Simd::Avx512 : Simd::Avx512Rows;
  if (hasSimd(best))
  {
    return best;
  }
#endif
  return hasSimd(Simd::Avx2) ? Simd::Avx2 : Simd::Four;
}

Simd packsFor(const KernelChoice& kernel, Simd simd)
{
  const bool isOfPaper = kernel.interpolation == Interpolation::Central ||
    (kernel.path == PathModel::Refracted && kernel.integrator == Integrator::Euler);
  return isOfPaper ? std::min(simd, Simd::Four) : simd;
}

template <class Real>
bool traceOnCpu(const RayTask<Real>& task, const Pass& pass, TracedPass& traced, int threads,
  const Monitor& monitor, Simd simd)
{
  const std::int64_t all = tilesOf(pass);
  traced.begin();
  traced.tilesDone +=
    traceTiles(task, pass, { traced.tilesDone, all }, traced, threads, monitor, simd);
  const bool isFinished = traced.tilesDone == all;
  traced.tilesDone = isFinished ? 0 : traced.tilesDone;
  return isFinished;
}

template <class Real>
std::int64_t traceTiles(const RayTask<Real>& task, const Pass& pass, const Tiles& tiles,
  TracedPass& traced, int threads, const Monitor& monitor, Simd simd)
{
  const KernelChoice& kernel = task.kernel;
  if (task.medium.planeStride > std::numeric_limits<std::uint32_t>::max())
  {
    simd = Simd::None; // the others multiply strides of 32 bits
  }
  simd = packsFor(kernel, simd);
  const auto traceWith = [&](auto marchBatches)
  { return traceTilesWith(task, marchBatches, pass, tiles, traced, threads, monitor); };
  constexpr bool isSingle = std::is_same_v<Real, float>;
  constexpr int ofAvx512 = isSingle ? 16 : 8, ofAvx2 = isSingle ? 8 : 4;
  if constexpr (isCompiledFor(Simd::Avx512))
  {
    if (simd == Simd::Avx512)
    {
      return traceWith(simdMarch<Real, ofAvx512>(kernel));
    }
  }
  if constexpr (isCompiledFor(Simd::Avx512Rows))
  {
    if (simd == Simd::Avx512Rows)
    {
      return traceWith(simdMarchByRows<Real, ofAvx512>(kernel));
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

template RayTask<float> makeTask(const Medium<float>&, const HomogeneityMap<float>*,
  const FieldGradientsView&, const Light&, const RaySettings&);
template RayTask<double> makeTask(const Medium<double>&, const HomogeneityMap<double>*,
  const FieldGradientsView&, const Light&, const RaySettings&);
template bool traceOnCpu(
  const RayTask<float>&, const Pass&, TracedPass&, int, const Monitor&, Simd);
template bool traceOnCpu(
  const RayTask<double>&, const Pass&, TracedPass&, int, const Monitor&, Simd);
template std::int64_t traceTiles(
  const RayTask<float>&, const Pass&, const Tiles&, TracedPass&, int, const Monitor&, Simd);
template std::int64_t traceTiles(
  const RayTask<double>&, const Pass&, const Tiles&, TracedPass&, int, const Monitor&, Simd);

} // namespace schlieren
