// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DataParts.h"

#include <cstddef>
#include <deque>
#include <functional>
#include <vector>

namespace filters
{

/// The ranks, each with a PieceWorker; rank 0 is the first.
class PieceRanks
{
public:
  PieceRanks() = default;
  PieceRanks(const PieceRanks&) = delete;
  PieceRanks& operator=(const PieceRanks&) = delete;
  virtual ~PieceRanks() = default;

  virtual std::size_t Count() const = 0;
  /// Whether the others may help with data that rank 0 has alone.
  virtual bool MayHelp() const = 0;
  /// One request for each rank, and its answer; both are empty for ranks that nothing is requested of. `meanwhile`: what rank 0
  /// does while others work. Throws std::runtime_error where a rank does not answer.
  virtual std::vector<std::vector<char>> Request(
    std::vector<std::vector<char>> requests, const std::function<void()>& meanwhile = nullptr) = 0;
  /// How many threads each may have.
  virtual int GetThreads() const = 0;
};

/// Begins to read an answer. Throws what the rank says that is wrong: ArraysMissing or std::runtime_error.
Reader readerOf(const std::vector<char>& answer);
/// The same of all ranks; at the end of those that nothing was requested of. The answers must outlive them.
std::deque<Reader> readersOf(const std::vector<std::vector<char>>& answers);

} // namespace filters
