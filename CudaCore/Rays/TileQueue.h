// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>

namespace schlieren
{

/// Consecutive tiles of a pass that are to be traced. Threads of this process take them from the front, what is given
/// to other processes comes from the back. For many threads.
class TileQueue
{
public:
  TileQueue(std::int64_t first, std::int64_t end)
    : front_(first)
    , back_(end)
  {
  }

  struct Tiles
  {
    std::int64_t first, end; ///< first == end: none are left
    std::int64_t count() const { return end - first; }
  };

  Tiles takeFront(std::int64_t count = 1)
  {
    const std::lock_guard<std::mutex> guard(lock_);
    const std::int64_t first = front_;
    front_ += std::min(count, back_ - front_);
    return { first, front_ };
  }
  Tiles takeBack(std::int64_t count)
  {
    const std::lock_guard<std::mutex> guard(lock_);
    const std::int64_t end = back_;
    back_ -= std::min(count, back_ - front_);
    return { back_, end };
  }

  /// Those that nobody has taken.
  Tiles left() const
  {
    const std::lock_guard<std::mutex> guard(lock_);
    return { front_, back_ };
  }

private:
  mutable std::mutex lock_;
  std::int64_t front_, back_;
};

} // namespace schlieren
