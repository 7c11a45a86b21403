// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/RayExit.h"

#include <cstdint>

namespace schlieren
{

/// The rays of one pass as optics and film read them.
struct TracedRays
{
  Pass pass;
  const RayExit* exits; ///< row by row

  std::int64_t rayOf(std::int64_t column, std::int64_t row) const
  {
    return (row - pass.firstRow) * pass.columns + column - pass.firstColumn;
  }
};

} // namespace schlieren
