// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PieceRanks.h"

#include <memory>

namespace filters
{

/// A source that queries ranks. Several filters may use it, one after the other, each with connections of its own.
class SourceOfRanks
{
public:
  SourceOfRanks() = default;
  SourceOfRanks(const SourceOfRanks&) = delete;
  SourceOfRanks& operator=(const SourceOfRanks&) = delete;
  virtual ~SourceOfRanks() = default;

  /// Queries these from now on. False where one of them has not what is needed of the data.
  virtual bool useRanks(const std::shared_ptr<PieceRanks>& ranks) const = 0;
  /// Whether it does.
  virtual bool usesRanks(const PieceRanks& ranks) const = 0;
};

} // namespace filters
