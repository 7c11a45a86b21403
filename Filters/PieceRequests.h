// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "AmrLevels.h"
#include "PieceRanks.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

class vtkDataObject;

namespace filters
{

/// What rank 0 requests of the ranks so that each makes its piece.
struct PieceRequests
{
  std::optional<AmrLevels> levels;     // where the data are such blocks
  std::size_t fields;                  // besides N
  bool areOfOne;                       // the ranks' data are parts of one dataset
  std::vector<std::vector<char>> make; // PieceWorker::Make, of each rank
};

/// Finds the ranges of fields that are those of all ranks, where the parts of one mesh on several ranks meet, or the levels of
/// blocks, and which cells of others each rank needs there. `number`: of the pieces. `bodies`: may be null. `hasFields`: whether
/// they get the fields that tint. Throws std::runtime_error where a rank fails or none has a field.
PieceRequests requestsForPieces(
  PieceRanks& ranks, std::uint64_t number, vtkDataObject* bodies, bool hasFields);

} // namespace filters
