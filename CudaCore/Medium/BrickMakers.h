// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Several processes that make the bricks of one tree. Each has a BrickMaker of its own, with the same rules.
#pragma once

#include "Medium/Brick.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace schlieren
{

/// A brick that is to be made of samples.
struct BrickTask
{
  BrickRequest request;
  Box box;                       ///< that its maker looks at
  MediumSource::Content content; ///< of it
  Lattice lattice;
  bool hasEdges; ///< so that the lattice's distances are needed, too
};

class BrickMakers
{
public:
  BrickMakers() = default;
  BrickMakers(const BrickMakers&) = delete;
  BrickMakers& operator=(const BrickMakers&) = delete;
  virtual ~BrickMakers() = default;

  virtual std::int32_t count() const = 0;
  /// Makes bricks here, by the numbers of their tasks.
  using MakeHere = std::function<void(const std::vector<std::size_t>& tasks)>;
  /// Each as Brick::toBytes(), in the order of the tasks; empty: it has been made here, or is to be. Of a remote source what it
  /// says of their boxes is prepared. Called by one thread. Throws where a process does not answer.
  virtual std::vector<std::vector<char>> make(const BrickRules& rules,
    const std::vector<BrickTask>& tasks, const MakeHere& makeHere) const = 0;
};

} // namespace schlieren
