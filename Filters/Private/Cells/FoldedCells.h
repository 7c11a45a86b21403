// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Vectors.h"

#include <cstdint>

namespace filters
{

class CellTree;

/// Cells in which points are found twice, or not at all.
struct FoldedCells
{
  std::int64_t count = 0;
  Vector place{}; ///< the mean of the first one's points
};

/// Counts cells whose corners (or points, of curved cells) have volumes of both signs, and cells
/// whose sign is the rarer one in their block and that lie in another cell. Those that are merely
/// numbered the other way round are sampled as others, and do not count. Of the cells with the rarer
/// sign, tests the first 1000.
FoldedCells foldedIn(const CellTree& tree);

} // namespace filters
