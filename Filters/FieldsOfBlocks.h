// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "AmrField.h"
#include "DataParts.h"
#include "RefractivityModels.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace filters
{

/// What a rank has of adaptive meshes while the ranks give each other blocks and copies of cells. Its functions answer
/// requests, see PieceWorker::Kind; those throw std::runtime_error that are not understood.
struct FieldsOfBlocks
{
  std::vector<AmrField> fields; // the first is N
  Tally tally;
  std::string label;
  std::vector<std::uint64_t> firstImages; // of each rank, and the number of all

  /// The numbers of images, of which it has no blocks any more.
  void giveBlocks(Reader& request, std::vector<char>& answer);
  /// What several ranks' giveBlocks() have answered.
  void takeBlocks(Reader& request);
  /// The new numbers of all images, and `firstImages`.
  void renumber(Reader& request);
  /// The number of the rank that needs them.
  void giveCellsAround(Reader& request, std::vector<char>& answer) const;
  /// What several ranks' giveCellsAround() have answered.
  void addCells(Reader& request);

private:
  void forAnswers(
    Reader& request, const std::function<void(AmrField& field, Reader& answer)>& read);
};

} // namespace filters
