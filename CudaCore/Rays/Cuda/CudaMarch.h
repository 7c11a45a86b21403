// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/March/RayTask.h"
#include "Rays/Tiles.h"

#include <cuda_runtime.h>

#include <cstdint>

namespace schlieren
{

// A warp traces the rays of 8 x 4 pixels, a block those of 16 x 8: near each other, they look at the
// same samples of the medium.
constexpr int warpColumns = 8, warpRows = 4;
constexpr int warpsAlong = 2, warpsUp = 2;
constexpr int blockColumns = warpsAlong * warpColumns;
constexpr int blockRows = warpsUp * warpRows;
constexpr int threadsPerWarp = 32;
constexpr int threadsPerBlock = warpsAlong * warpsUp * threadsPerWarp;
static_assert(warpColumns * warpRows == threadsPerWarp);
static_assert(blockRows == bandRows);

/// Sums up all rays of the passes.
struct MarchTotals
{
  long long worstDrift; ///< as the bits of a double, which grow with it
  unsigned long long crossed;
};

/// Some bands of passes, from `firstBand` on. All pointers are to the device's memory.
struct MarchedBands
{
  const PlacedPass* passes;
  int count; ///< of passes
  std::int64_t firstBand;
  RayExit* exits;
  MarchTotals* totals;
};

/// Starts the kernel of the task, with all that it points to on the device. CudaMarch*.cu instantiate it for one scheme
/// each, those that take longest for one precision, so that they can be compiled at the same time.
template <class Scheme, class Real>
void launchMarch(
  const RayTask<Real>& task, const MarchedBands& bands, const dim3& blocks, cudaStream_t stream);

} // namespace schlieren
