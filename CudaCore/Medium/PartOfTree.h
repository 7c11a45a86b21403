// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// A tree whose bricks several processes have: one makes it, has its nodes and some of its bricks, and gives each of the
// others to a process, its owner, as soon as it is made.
#pragma once

#include "Medium/BrickRays.h"
#include "Medium/BrickStore.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// The processes; the first one, 0, is that which makes the tree.
class BrickOwners
{
public:
  BrickOwners() = default;
  BrickOwners(const BrickOwners&) = delete;
  BrickOwners& operator=(const BrickOwners&) = delete;
  virtual ~BrickOwners() = default;

  virtual std::int32_t count() const = 0;
  /// What follows is of another tree: owners forget what they have.
  virtual void begin(const BrickLayout& layout, std::size_t bytesOfReal) = 0;
  /// Gives bricks to a process: DeliveredBricks.
  virtual void put(std::int32_t owner, const std::vector<char>& bricks) = 0;
  /// See sumUp(); of each owner its segments. Throws Error where one does not answer.
  virtual std::vector<std::vector<LeafSums>> sumUp(
    const std::vector<std::vector<LeafSegment>>& ofOwners) = 0;
  /// The samples of bricks, of each owner one after the other. Throws Error likewise.
  virtual std::vector<std::vector<char>> fetch(
    const std::vector<std::vector<std::int32_t>>& ofOwners) = 0;
};

/// Bricks on their way, with their numbers at their owner. They replace those that had the same numbers.
template <class Real>
struct DeliveredBricks
{
  std::vector<std::int32_t> samplesNumbers, mapNumbers, gradientNumbers;
  std::vector<Real> samples;
  std::vector<std::int16_t> maps;
  std::vector<float> gradients;

  std::size_t count() const
  {
    return samplesNumbers.size() + mapNumbers.size() + gradientNumbers.size();
  }
  std::vector<char> toBytes() const;
};

/// What one process has of a tree that another one makes.
template <class Real>
class PartOfTree
{
public:
  explicit PartOfTree(const BrickLayout& layout);

  /// DeliveredBricks::toBytes. False where they are not as many as they say.
  bool put(const char* bricks, std::size_t size);
  /// False where a segment is of none of its bricks.
  bool sumUp(
    const std::vector<LeafSegment>& segments, std::vector<LeafSums>& sums, int threads) const;

  /// False where some are not there.
  bool fetch(const std::vector<std::int32_t>& bricks, std::vector<char>& samples) const;

  const std::vector<Real>& samples() const { return samples_.values(); }
  const std::vector<std::int16_t>& gasDistances() const { return maps_.values(); }
  const std::vector<float>& gradientValues() const { return gradients_.values(); }

private:
  BrickLayout layout_;
  BrickStore<Real> samples_;
  BrickStore<std::int16_t> maps_;
  BrickStore<float> gradients_;
};

} // namespace schlieren
