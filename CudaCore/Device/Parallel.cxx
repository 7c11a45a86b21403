// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/Parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace schlieren
{

int threadCount(int requested)
{
  if (requested > 0)
  {
    return requested;
  }
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

bool parallelFor(std::int64_t count, std::int64_t grain, int threads,
  const std::function<void(std::int64_t, std::int64_t)>& body, const Monitor& monitor)
{
  const std::int64_t pieces = (count + grain - 1) / grain;
  std::atomic<std::int64_t> nextPiece{ 0 };
  std::atomic<std::int64_t> piecesDone{ 0 };
  std::atomic<bool> stop{ false };
  std::exception_ptr failure;
  std::mutex failureLock;

  auto work = [&](bool isCaller)
  {
    try
    {
      for (std::int64_t piece = nextPiece++; piece < pieces && !stop; piece = nextPiece++)
      {
        body(piece * grain, std::min(count, (piece + 1) * grain));
        const std::int64_t done = ++piecesDone;
        if (isCaller && monitor.progress)
        {
          monitor.progress(static_cast<double>(done) / static_cast<double>(pieces));
        }
        if (isCaller && monitor.aborted && monitor.aborted())
        {
          stop = true;
        }
      }
    }
    catch (...)
    {
      stop = true;
      const std::lock_guard<std::mutex> guard(failureLock);
      if (!failure)
      {
        failure = std::current_exception();
      }
    }
  };

  std::vector<std::thread> others;
  const std::int64_t wanted = std::min<std::int64_t>(threadCount(threads), pieces);
  try
  {
    for (std::int64_t i = 1; i < wanted; ++i)
    {
      others.emplace_back(work, false);
    }
  }
  catch (const std::system_error&)
  {
    // The system gives no more threads: those that there are do the work.
  }
  work(true);
  for (std::thread& other : others)
  {
    other.join();
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  return !stop;
}

} // namespace schlieren
