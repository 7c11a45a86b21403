// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/PartOfTree.h"
#include "Rays/Channel.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace schlieren
{

/// Owners of bricks that are reached by channels, each with a RayWorker.
class BrickChannels : public BrickOwners
{
public:
  /// To all but the first; as many as at the beginning.
  explicit BrickChannels(std::vector<Channel*> channels)
    : channels_(std::move(channels))
  {
  }

  const std::vector<Channel*>& channels() const { return channels_; }
  std::uint64_t tree() const { return tree_; } ///< a number of it

  std::int32_t count() const override { return static_cast<std::int32_t>(channels_.size()) + 1; }
  void begin(const BrickLayout& layout, std::size_t bytesOfReal) override;
  void put(std::int32_t owner, const std::vector<char>& bricks) override;
  std::vector<std::vector<LeafSums>> sumUp(
    const std::vector<std::vector<LeafSegment>>& ofOwners) override;
  std::vector<std::vector<char>> fetch(
    const std::vector<std::vector<std::int32_t>>& ofOwners) override;

private:
  template <class Item>
  std::vector<std::vector<char>> request(
    std::uint32_t kind, const std::vector<std::vector<Item>>& ofOwners, std::size_t bytesOfAnswer);

  std::vector<Channel*> channels_;
  BrickLayout layout_{};
  std::uint32_t bytesOfReal_ = 0;
  std::uint64_t tree_ = 0;
  std::vector<std::uint64_t> puts_; ///< messages to each channel with bricks of it
};

/// Where nobody but it has a part of the medium.
[[noreturn]] void throwAbsentOwner(std::int32_t owner);

} // namespace schlieren
