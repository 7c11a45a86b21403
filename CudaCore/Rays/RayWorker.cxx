// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/RayWorker.h"

#include "Device/Parallel.h"
#include "Rays/TeamMessages.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <exception>
#include <mutex>
#include <type_traits>
#include <utility>

namespace schlieren
{

struct RayWorker::Arrays
{
  struct Held
  {
    std::uint64_t version = 0; ///< 0: there is none
    std::vector<char> message; ///< that it came in
  };
  std::array<Held, arraysOfTask> held;

  void keep(std::vector<char>&& message)
  {
    ArrayMessage head;
    if (read(message, head) && head.array < arraysOfTask)
    {
      held[head.array] = { head.version, std::move(message) };
    }
  }

  /// Makes the task's pointers point to the arrays. False where one is not there.
  template <class Real>
  bool bind(TilesMessage<Real>& asked) const
  {
    bool isComplete = true;
    forArrays(asked.task,
      [&](std::size_t n, auto*& pointer)
      {
        using Value = std::remove_reference_t<decltype(*pointer)>;
        pointer = nullptr;
        if (asked.offsets[n] != nowhere)
        {
          isComplete = isComplete && held[n].version == asked.versions[n];
          const void* first = held[n].message.data() + sizeof(ArrayMessage);
          pointer = isComplete ? static_cast<Value*>(first) + asked.offsets[n] : nullptr;
        }
      });
    return isComplete;
  }

  template <class Real>
  bool trace(const std::vector<char>& message, Channel& channel, int threads) const
  {
    TilesMessage<Real> asked;
    if (!read(message, asked) || !hasSimd(asked.simd) || !bind(asked))
    {
      return false;
    }
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const auto fields = static_cast<std::size_t>(asked.task.gradients.count);
    RaysMessage head;
    head.fields = static_cast<std::uint32_t>(fields);
    const TileQueue::Tiles& tiles = asked.head.tiles;
    head.number = asked.head.number;
    head.tiles = tiles;
    const std::size_t rays = raysOf(asked.pass, tiles);
    std::vector<char> answer = messageOf(head, rays * (sizeof(RayExit) + fields * sizeof(float)));
    char* const exits = answer.data() + sizeof(RaysMessage);
    char* const gathered = exits + rays * sizeof(RayExit);
    std::vector<std::size_t> firstRays;
    std::size_t first = 0;
    for (std::int64_t tile = tiles.first; tile < tiles.end; ++tile)
    {
      firstRays.push_back(first);
      first += raysOf(passOfTile(asked.pass, tile));
    }
    std::mutex lock; // of the head
    parallelFor(tiles.count(), 1, threads,
      [&](std::int64_t number, std::int64_t)
      {
        const Pass pass = passOfTile(asked.pass, tiles.first + number);
        TracedPass traced;
        traced.resize(pass, static_cast<int>(fields));
        traceOnCpu(asked.task, pass, traced, 1, {}, asked.simd);
        const std::size_t ray = firstRays[static_cast<std::size_t>(number)];
        std::memcpy(exits + ray * sizeof(RayExit), traced.exits.data(),
          traced.exits.size() * sizeof(RayExit));
        if (fields > 0)
        {
          std::memcpy(gathered + ray * fields * sizeof(float), traced.gathered.data(),
            traced.gathered.size() * sizeof(float));
        }
        const std::lock_guard<std::mutex> guard(lock);
        head.crossed += traced.crossed;
        head.worstDrift = std::max(head.worstDrift, traced.worstDrift);
      });
    head.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    std::memcpy(answer.data(), &head, sizeof(head));
    channel.send(std::move(answer));
    return true;
  }
};

RayWorker::RayWorker()
  : arrays_(std::make_unique<Arrays>())
{
}

RayWorker::~RayWorker() = default;

std::uint32_t RayWorker::kindOf(const std::vector<char>& message)
{
  std::uint32_t kind = 0;
  read(message, kind);
  return kind;
}

void RayWorker::answer(std::vector<char> message, Channel& channel, int threads)
{
  if (kindOf(message) == Array)
  {
    arrays_->keep(std::move(message));
    return;
  }
  TilesHead asked;
  if (!read(message, asked) || asked.kind != Tiles)
  {
    return;
  }
  RaysMessage lacking;
  lacking.kind = Lacking;
  lacking.number = asked.number;
  lacking.tiles = asked.tiles;
  bool isTraced = false;
  try
  {
    isTraced = asked.bytesOfReal == sizeof(float)
      ? arrays_->trace<float>(message, channel, threads)
      : arrays_->trace<double>(message, channel, threads);
  }
  catch (const std::exception&) // there is no memory: others trace them
  {
  }
  if (!isTraced)
  {
    channel.send(messageOf(lacking));
  }
}

} // namespace schlieren
