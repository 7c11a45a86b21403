// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/Ranks/RayWorker.h"

#include "Rays/Cpu/CpuTracer.h"
#include "Rays/Ranks/TaskArrays.h"

#include <cstring>
#include <utility>

namespace schlieren
{

struct RayWorker::Arrays
{
  TaskArrays ofTask;
  TracedPass traced; ///< its memory serves again

  /// The rays of its tiles, tile after tile.
  template <class Real>
  std::vector<char> traceTiles(
    const TraceMessage<Real>& request, const Passes& passes, const Tiles& tiles, int threads)
  {
    if (!hasSimd(request.simd))
    {
      throw Error("The processors of the processes differ, so that rays would, too.");
    }
    traced.resize(passes);
    traced.crossed = 0;
    traced.worstDrift = 0;
    schlieren::traceTiles(request.task, passes, tiles, traced, threads, {}, request.simd);
    const std::size_t rays = passes.raysOf(tiles);
    std::vector<char> answer =
      messageOf(RaysHead{ traced.crossed, traced.worstDrift }, rays * sizeof(RayExit));
    char* exits = answer.data() + sizeof(RaysHead);
    forRowsOf(passes, tiles,
      [&](std::size_t first, std::size_t count)
      {
        std::memcpy(exits, traced.exits.data() + first, count * sizeof(RayExit));
        exits += count * sizeof(RayExit);
      });
    return answer;
  }

  template <class Real>
  std::vector<char> trace(const std::vector<char>& message, int process, int processes, int threads)
  {
    TraceMessage<Real> request;
    std::vector<Pass> passes;
    if (!read(message, request) || !readPasses(message, request, passes) || !ofTask.bind(request))
    {
      throw Error("A process has not all of the medium. Update the filter again.");
    }
    return traceTiles(
      request, passes, tilesOfProcess(request.first, request.end, process, processes), threads);
  }
};

RayWorker::RayWorker(int process, int processes)
  : arrays_(std::make_unique<Arrays>())
  , process_(process)
  , processes_(processes)
{
}

RayWorker::~RayWorker() = default;

std::uint32_t RayWorker::kindOf(const std::vector<char>& request)
{
  std::uint32_t kind = 0;
  read(request, kind);
  return kind;
}

std::vector<char> RayWorker::answer(const std::vector<char>& request, int threads)
{
  if (kindOf(request) == Array)
  {
    arrays_->ofTask.keep(request);
    return {};
  }
  TraceHead head;
  read(request, head);
  return head.bytesOfReal == sizeof(float)
    ? arrays_->trace<float>(request, process_, processes_, threads)
    : arrays_->trace<double>(request, process_, processes_, threads);
}

} // namespace schlieren
