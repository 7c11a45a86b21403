// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// Memory of bricks of values, in one piece and addressed by their numbers.
template <class Value>
class BrickStore
{
public:
  struct Layout
  {
    std::size_t perBrick;   ///< values
    std::size_t zeros = 0;  ///< bricks of zeros, the first ones, which remain
    std::size_t behind = 0; ///< zeros behind the last brick
    std::size_t usual = 0;  ///< bytes that there may be of it all
  };
  explicit BrickStore(const Layout& layout);

  void clear();
  std::int32_t add(const std::vector<Value>& values);
  /// Replaces brick `number`, which may be beyond the last one. `values`: as they are in memory, at any address.
  void put(std::int32_t number, const char* values);
  void remove(std::int32_t brick) { free_.push_back(brick); }

  /// Keeps those that are named, in this order; the bricks of zeros are among them, as the first.
  void arrange(const std::vector<std::int32_t>& bricks);

  const std::vector<Value>& values() const { return values_; }
  std::size_t bytesUsed() const
  {
    return values_.size() * sizeof(Value) - free_.size() * bytesOfBrick();
  }
  std::size_t bytesOfBrick() const { return layout_.perBrick * sizeof(Value); }

private:
  std::size_t count() const { return (values_.size() - layout_.behind) / layout_.perBrick; }
  Value* brick(std::int32_t number);
  void reserve(std::size_t values);
  void permute(const std::vector<std::int32_t>& order);

  Layout layout_;
  std::vector<Value> values_;
  std::vector<std::int32_t> free_;
};

} // namespace schlieren
