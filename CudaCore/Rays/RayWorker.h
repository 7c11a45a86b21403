// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/Channel.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace schlieren
{

/// Traces rays for another process.
class RayWorker
{
public:
  RayWorker();
  ~RayWorker();

  /// The first bytes of each message. Other messages on the same channel have other numbers.
  enum Kind : std::uint32_t
  {
    Array = 100, ///< to a worker: an array of the medium
    Tiles,       ///< to a worker: to be traced
    Rays,        ///< from a worker: of tiles
    Lacking,     ///< from a worker: it has not the arrays that it needs, or no memory
    AskDevice,   ///< to a worker: which device it has
    DeviceIs     ///< from a worker: cudaCapability()
  };
  static std::uint32_t kindOf(const std::vector<char>& message);

  /// Does what a message of a TeamTracer requests, and answers. Throws nothing.
  void answer(std::vector<char> message, Channel& channel, int threads);

private:
  struct Arrays;
  std::unique_ptr<Arrays> arrays_;
};

} // namespace schlieren
