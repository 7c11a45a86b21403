// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/Parallel.h"

#include "Device/Cores.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace schlieren
{

int threadCount(int requested) { return requested > 0 ? requested : coresOfProcess(); }

bool parallelFor(std::int64_t count, std::int64_t grain, int threads,
  const std::function<void(std::int64_t, std::int64_t)>& body, const Monitor& monitor)
{
  return parallelFrom(0, count, grain, threads, body, { monitor.progress, monitor.aborted, {} }) ==
    count;
}

std::int64_t parallelFrom(std::int64_t first, std::int64_t count, std::int64_t grain, int threads,
  const std::function<void(std::int64_t, std::int64_t)>& body, const Monitor& monitor)
{
  const std::int64_t pieces = (count - first + grain - 1) / grain;
  std::atomic<std::int64_t> nextPiece{ 0 };
  std::atomic<std::int64_t> piecesDone{ 0 };
  std::atomic<bool> stop{ false };
  std::exception_ptr failure;
  std::mutex failureLock;

  auto work = [&](bool isCaller)
  {
    try
    {
      while (!stop)
      {
        const std::int64_t piece = nextPiece++; // once taken it is done, so that no gaps are left
        if (piece >= pieces)
        {
          break;
        }
        const std::int64_t begin = first + piece * grain;
        body(begin, std::min(count, begin + grain));
        const std::int64_t done = ++piecesDone;
        if (isCaller && monitor.progress)
        {
          const auto before = static_cast<double>(first) / static_cast<double>(grain);
          monitor.progress(
            (before + static_cast<double>(done)) / (before + static_cast<double>(pieces)));
        }
        if (isCaller &&
          ((monitor.aborted && monitor.aborted()) || (monitor.paused && monitor.paused())))
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
  // The system gives no more threads, or no memory for them: those that there are do the work.
  catch (const std::system_error&)
  {
  }
  catch (const std::bad_alloc&)
  {
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
  return std::min(count, first + nextPiece * grain);
}

} // namespace schlieren
