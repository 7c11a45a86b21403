// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes the values of bricks for another rank: how many there are, and these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace schlieren
{

template <class Value>
void appendCounted(const std::vector<Value>& values, std::vector<char>& bytes)
{
  static_assert(std::is_trivially_copyable_v<Value>);
  const std::uint64_t count = values.size();
  const auto add = [&bytes](const void* first, std::size_t size)
  {
    const char* const from = static_cast<const char*>(first);
    bytes.insert(bytes.end(), from, from + size);
  };
  add(&count, sizeof(count));
  add(values.data(), values.size() * sizeof(Value));
}

/// Where the values are, and behind them; null where there are fewer than it says. `bytes` and `size`: what is left.
template <class Value>
const char* takeCounted(const char*& bytes, std::size_t& size, std::uint64_t& count)
{
  if (size < sizeof(count))
  {
    return nullptr;
  }
  std::memcpy(&count, bytes, sizeof(count));
  const char* first = bytes + sizeof(count);
  size -= sizeof(count);
  if (count > size / sizeof(Value))
  {
    return nullptr;
  }
  size -= count * sizeof(Value);
  bytes = first + count * sizeof(Value);
  return first;
}

/// The same into a vector. False where there are fewer.
template <class Value>
bool takeCounted(const char*& bytes, std::size_t& size, std::vector<Value>& values)
{
  std::uint64_t count = 0;
  const char* const first = takeCounted<Value>(bytes, size, count);
  if (!first)
  {
    return false;
  }
  values.resize(static_cast<std::size_t>(count));
  if (count > 0)
  {
    std::memcpy(values.data(), first, values.size() * sizeof(Value));
  }
  return true;
}

} // namespace schlieren
