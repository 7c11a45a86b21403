// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/CudaPass.h"
#include "Rays/RayExit.h"
#include "Rays/Tiles.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace schlieren
{

/// The rays of passes, one after the other.
struct TracedPass
{
  RayExits exits;
  std::unique_ptr<CudaPass> onDevice; ///< the rays, if they stay there; `exits` is empty then
  std::int64_t crossed = 0;           ///< rays that met the grid
  double worstDrift = 0;              ///< of | |p| / n - 1 | where rays leave the grid
  std::int64_t tilesDone = 0;         ///< where a pause has interrupted tracing on the CPU; else 0

  /// Before tracing on the CPU begins or resumes.
  void begin()
  {
    crossed = tilesDone == 0 ? 0 : crossed;
    worstDrift = tilesDone == 0 ? 0 : worstDrift;
  }

  /// Makes room on the host.
  void resize(const Passes& passes)
  {
    onDevice.reset();
    tilesDone = 0;
    exits.resize(passes.rays());
  }
  std::size_t bytes() const
  {
    return (exits.size() + (onDevice ? onDevice->size() : 0)) * sizeof(RayExit);
  }
};

} // namespace schlieren
