// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Types.h"

#include <cstdint>
#include <functional>

namespace schlieren
{

/// The number of threads to use: `requested`, or coresOfProcess() where that is 0.
int threadCount(int requested);

/// Calls body(begin, end) for consecutive pieces of [0, count), at most `grain` long, from
/// `threads` threads, the calling one among them. The pieces do not depend on the number of
/// threads. Progress (0...1) and abort are called on the calling thread between its pieces; after
/// an abort no further piece is begun.
/// Returns false if aborted. The first exception that a piece throws is thrown again here.
bool parallelFor(std::int64_t count, std::int64_t grain, int threads,
  const std::function<void(std::int64_t begin, std::int64_t end)>& body,
  const Monitor& monitor = {});

/// The same for [first, count), where a pause, called like abort, ends it too. Returns where to continue: all before
/// that is done, and nothing after it. At least one piece is done whatever the monitor says.
std::int64_t parallelFrom(std::int64_t first, std::int64_t count, std::int64_t grain, int threads,
  const std::function<void(std::int64_t begin, std::int64_t end)>& body, const Monitor& monitor);

} // namespace schlieren
