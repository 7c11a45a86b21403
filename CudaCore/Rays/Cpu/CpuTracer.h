// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/March/RayTask.h"
#include "Rays/Tiles.h"
#include "Rays/TracedPass.h"

namespace schlieren
{

/// Which instructions trace rays side by side.
enum class Simd
{
  None, ///< one ray at a time
  Four, ///< what every processor of the architecture has (x86-64: SSE2)
  Avx2,
  Avx512
};

/// Whether this processor has them, and the program was compiled for them (SCHLIEREN_SIMD).
bool hasSimd(Simd simd);

/// The best ones that it has.
Simd bestSimd();

/// Traces passes on the CPU into `traced`, which has their size, or resumes them. Returns false if aborted or
/// paused; the same call then does the rest. `simd` must be one that the processor has.
template <class Real>
bool traceOnCpu(const RayTask<Real>& task, const Passes& passes, TracedPass& traced, int threads,
  const Monitor& monitor, Simd simd = bestSimd());

/// Traces tiles of passes until the monitor stops it. Adds to what `traced` counts. Returns how many are done: the first
/// ones.
template <class Real>
std::int64_t traceTiles(const RayTask<Real>& task, const Passes& passes, const Tiles& tiles,
  TracedPass& traced, int threads, const Monitor& monitor, Simd simd = bestSimd());

/// Counts the tiles that this process has traced so far, or was to trace, for whatever purpose.
std::int64_t tilesTracedOnCpu();

} // namespace schlieren
