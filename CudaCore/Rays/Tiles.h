// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/RayExit.h"

#include <algorithm>
#include <cstdint>

namespace schlieren
{

/// Squares of pixels that a thread takes at once: their rays read the same samples of the medium. Row by row.
constexpr std::int64_t tileEdge = 16;
inline std::int64_t tilesAlong(const Pass& pass)
{
  return (pass.columns + tileEdge - 1) / tileEdge;
}
inline std::int64_t tilesOf(const Pass& pass)
{
  return tilesAlong(pass) * ((pass.rows + tileEdge - 1) / tileEdge);
}

/// Tiles of a pass, or bands of it on a GPU: first, first + step, and so on, up to the end.
struct Tiles
{
  std::int64_t first, end;
  std::int64_t step = 1;

  std::int64_t count() const { return (std::max(first, end) - first + step - 1) / step; }
};

/// Which of the tiles first ... end - 1 one of `processes` ranks traces: every nth one, whatever the range is.
inline Tiles tilesOfProcess(
  std::int64_t first, std::int64_t end, std::int64_t process, std::int64_t processes)
{
  const std::int64_t next = (first - process + processes - 1) / processes;
  return { process + std::max<std::int64_t>(0, next) * processes, end, processes };
}

} // namespace schlieren
