// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Ranks that make the bricks of one tree. Each has a BrickMaker of its own, with the same rules.
#pragma once

#include "Medium/Tree/Brick.h"

#include <vector>

namespace schlieren
{

class BrickMakers
{
public:
  BrickMakers() = default;
  BrickMakers(const BrickMakers&) = delete;
  BrickMakers& operator=(const BrickMakers&) = delete;
  virtual ~BrickMakers() = default;

  virtual int count() const = 0;
  /// Each as Brick::toBytes(), in the order of the requests: in each rank those that BrickMaker::makeShare() makes.
  /// Called by one thread. Throws where a rank has failed.
  virtual std::vector<std::vector<char>> make(
    const BrickRules& rules, const std::vector<BrickRequest>& requests) const = 0;
};

} // namespace schlieren
