// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/Ranks/ProcessTracer.h"

#include "Device/Parallel.h"
#include "Rays/Ranks/RayMessages.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace schlieren
{

namespace
{

/// How long ranks trace before rank 0 looks whether it is to stop.
constexpr double secondsAtOnce = 0.05;

double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool isToStop(const Monitor& monitor)
{
  return (monitor.aborted && monitor.aborted()) || (monitor.paused && monitor.paused());
}

/// Adds what an answer counts and returns where its rays begin. Throws Error where it has not that many.
const char* exitsOf(const std::vector<char>& answer, std::size_t rays, TracedPass& traced)
{
  RaysHead head;
  if (!read(answer, head) || answer.size() != sizeof(head) + rays * sizeof(RayExit))
  {
    throw Error("A process has sent other rays than were requested.");
  }
  traced.crossed += head.crossed;
  traced.worstDrift = std::max(traced.worstDrift, head.worstDrift);
  return answer.data() + sizeof(head);
}

/// Puts the rays of a rank's tiles where they belong.
void putTiles(
  const std::vector<char>& answer, const Passes& passes, const Tiles& tiles, TracedPass& traced)
{
  const char* exits = exitsOf(answer, passes.raysOf(tiles), traced);
  forRowsOf(passes, tiles,
    [&](std::size_t first, std::size_t count)
    {
      std::memcpy(traced.exits.data() + first, exits, count * sizeof(RayExit));
      exits += count * sizeof(RayExit);
    });
}

} // namespace

template <class Real>
struct ProcessTracer<Real>::State
{
  /// What a task's pointers point into.
  struct ArrayOfTask
  {
    const void* first = nullptr;
    std::size_t bytes = 0;
    std::uint64_t version = 0;
  };
  std::array<ArrayOfTask, arraysOfTask> arrays;

  static std::uint64_t newVersion()
  {
    static std::atomic<std::uint64_t> last{ 0 };
    return ++last;
  }

  template <class Value>
  void set(std::size_t number, const Value* first, std::size_t count)
  {
    ArrayOfTask& array = arrays[number];
    array = { first, count * sizeof(Value), array.version > 0 ? array.version : newVersion() };
  }
  template <class Values>
  void set(std::size_t number, const Values& values)
  {
    set(number, values.data(), values.size());
  }

  /// Finds the arrays of the medium, which has not changed, but where they are may have.
  void locate(const Medium<Real>& medium)
  {
    if (!medium.tree)
    {
      set(samplesOfTask, medium.volume.samples);
      set(solidOfTask, medium.solid);
    }
    else
    {
      set(samplesOfTask, medium.tree->samples());
      set(leavesOfTask, medium.tree->leaves());
      set(rootsOfTask, medium.tree->roots());
      set(childrenOfTask, medium.tree->children());
      set(gasDistancesOfTask, medium.tree->gasDistances());
    }
  }

  /// What processes are to do, but for the tiles.
  TraceMessage<Real> requestFor(
    const Medium<Real>& medium, const RayTask<Real>& task, const Passes& passes)
  {
    locate(medium);
    TraceMessage<Real> message;
    message.simd = bestSimd();
    message.passes = passes.all().size();
    message.task = task;
    forArrays(message.task,
      [&](std::size_t n, auto*& pointer)
      {
        using Value = std::remove_reference_t<decltype(*pointer)>;
        message.offsets[n] =
          pointer != nullptr ? pointer - static_cast<Value*>(arrays[n].first) : nowhere;
        message.versions[n] = arrays[n].version;
        pointer = nullptr;
      });
    return message;
  }

  /// Sends the arrays of the request's task that the others have not got.
  void sendArrays(Processes& processes, const TraceMessage<Real>& request)
  {
    for (std::size_t n = 0; n < arraysOfTask; ++n)
    {
      const ArrayOfTask& array = arrays[n];
      std::uint64_t& sent = processes.ofRays().arrays[n];
      if (request.offsets[n] != nowhere && sent != array.version)
      {
        sent = 0; // where sending fails
        sendPieces({ RayWorker::Array, static_cast<std::uint32_t>(n), array.version }, array.first,
          array.bytes, [&](const std::vector<char>& piece) { processes.request(piece, {}); });
        sent = array.version;
      }
    }
  }
};

template <class Real>
ProcessTracer<Real>::ProcessTracer(const Medium<Real>& medium)
  : medium_(medium)
  , state_(std::make_unique<State>())
{
}

template <class Real>
ProcessTracer<Real>::~ProcessTracer() = default;

template <class Real>
bool ProcessTracer<Real>::trace(const RayTask<Real>& task, const Passes& passes, Processes& others,
  TracedPass& traced, int threads, const Monitor& monitor)
{
  TraceMessage<Real> request = state_->requestFor(medium_, task, passes);
  state_->sendArrays(others, request);
  const std::int64_t all = passes.tiles(), processes = others.others() + 1;
  const std::int64_t least = 4 * threadCount(threads) * processes;
  double& secondsPerTile = others.ofRays().secondsPerTile;
  traced.begin();
  while (traced.tilesDone < all)
  {
    const auto start = std::chrono::steady_clock::now();
    const double wanted =
      secondsPerTile > 0 ? std::min(static_cast<double>(all), secondsAtOnce / secondsPerTile) : 0;
    request.first = traced.tilesDone;
    request.end = std::min(all, request.first + std::max(least, static_cast<std::int64_t>(wanted)));
    const auto tilesOf = [&](std::int64_t process)
    { return tilesOfProcess(request.first, request.end, process, processes); };
    const auto answers = others.request(messageOf(request, passes.all()),
      [&] { traceTiles(task, passes, tilesOf(0), traced, threads, {}, request.simd); });
    for (std::size_t n = 0; n < answers.size(); ++n)
    {
      putTiles(answers[n], passes, tilesOf(static_cast<std::int64_t>(n) + 1), traced);
    }
    traced.tilesDone = request.end;
    secondsPerTile = secondsSince(start) / static_cast<double>(request.end - request.first);
    if (monitor.progress)
    {
      monitor.progress(static_cast<double>(traced.tilesDone) / static_cast<double>(all));
    }
    if (traced.tilesDone < all && isToStop(monitor))
    {
      return false;
    }
  }
  traced.tilesDone = 0;
  return true;
}

template class ProcessTracer<float>;
template class ProcessTracer<double>;

} // namespace schlieren
