// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "AmrLevels.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace filters
{

/// The rank that had better have each image, of which the ranks now have `firstImages[rank]` to before
/// `firstImages[rank + 1]`: neighbouring ones, along a space-filling curve, as many cells for each rank that has any. Nothing
/// where that does not save at least half of the copies that ranks need of each other's cells. `margin`: how many cells around
/// each block these are.
///
/// Readers that deal blocks out one by one scatter them over the ranks: then nearly every block has copies on all of its sides.
std::optional<std::vector<std::uint64_t>> betterOwners(
  const AmrLevels& levels, const std::vector<std::uint64_t>& firstImages, int margin);

} // namespace filters
