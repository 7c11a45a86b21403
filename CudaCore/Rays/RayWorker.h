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
    BeginRays,   ///< to a worker: what all rays through parts of the medium need
    Advance,     ///< to a worker, also from another one: rays that come to its part
    Advanced,    ///< from a worker: what has become of some of them
    PutBricks,   ///< to a worker: of a tree
    SumUp,       ///< to a worker: segments in these
    FetchBricks, ///< to a worker: numbers of some
    Found,       ///< from a worker: what SumUp and FetchBricks request
    AskDevice,   ///< to a worker: which device it has
    DeviceIs     ///< from a worker: cudaCapability()
  };
  static std::uint32_t kindOf(const std::vector<char>& message);

  /// Does what a message of a TeamTracer or a DistributedTracer requests, and answers. Throws nothing.
  void answer(std::vector<char> message, Channel& channel, int threads);

  /// Takes some of the rays that have come to its part of the medium further. Those that end, and those that come to the
  /// part of the first process, are sent to that, others to the workers that have what comes next. False where there are
  /// none. To be called while there is no message to be answered. Throws nothing.
  bool advance(Channel& channel, Peers& peers, int threads);

  /// Forgets rays that are left by a trace that has failed.
  void endTrace();

private:
  struct Arrays;
  std::unique_ptr<Arrays> arrays_;
};

} // namespace schlieren
