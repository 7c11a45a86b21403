// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/TeamTracer.h"

#include "Device/Parallel.h"
#include "Rays/TeamMessages.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <thread>
#include <type_traits>
#include <utility>

namespace schlieren
{

template <class Real>
struct TeamTracer<Real>::State
{
  /// What a task's pointers point into.
  struct ArrayOfTask
  {
    const void* first = nullptr;
    std::size_t bytes = 0;
    std::uint64_t version = 0;
  };
  std::array<ArrayOfTask, arraysOfTask> arrays;
  TaskVersions versions{ 0, -1 };
  bool hasFieldsOfTree = false;

  /// What is known of a worker.
  struct Worker
  {
    std::array<std::uint64_t, arraysOfTask> sent{}; ///< versions of arrays
    int failures = 0;                               ///< in a row
    double secondsPerTile = 0;                      ///< 0: not known yet
    std::deque<TileQueue::Tiles> given;             ///< tiles that have not come back
  };
  std::map<std::uint64_t, Worker> workers; ///< by the numbers of their channels

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
      set(0, medium.volume.samples);
      set(1, medium.solid);
    }
    else
    {
      set(0, medium.tree->samples());
      set(2, medium.tree->leaves());
      set(3, medium.tree->roots());
      set(4, medium.tree->children());
      set(5, medium.tree->gasDistances());
      set(7, medium.tree->gradientValues());
      set(8, medium.tree->gradientBricks());
    }
    hasFieldsOfTree = medium.tree != nullptr;
  }

  /// Finds the arrays of a task that are not the medium's: each bench that uses the medium has its own gradients.
  void update(const RayTask<Real>& task, const TaskVersions& now)
  {
    if (task.map.levels != nullptr && versions.homogeneityTolerance != now.homogeneityTolerance)
    {
      const std::int64_t* bricks = task.map.bricks;
      arrays[6].version = 0;
      set(6, task.map.levels, static_cast<std::size_t>(bricks[0] * bricks[1] * bricks[2]));
      versions.homogeneityTolerance = now.homogeneityTolerance;
    }
    const FieldGradientsView& fields = task.gradients;
    if (!hasFieldsOfTree && fields.count > 0 &&
      (arrays[7].first != fields.values || versions.gradients != now.gradients))
    {
      arrays[7].version = 0;
      set(7, fields.values,
        static_cast<std::size_t>(fields.count * fields.planeStride * (fields.lastCell[2] + 2)));
      versions.gradients = now.gradients;
    }
  }

  /// Sends tiles to a worker, and first the arrays that it has not got.
  void give(Channel& channel, Worker& worker, TilesMessage<Real>& message)
  {
    for (std::size_t n = 0; n < arraysOfTask; ++n)
    {
      if (message.offsets[n] == nowhere || worker.sent[n] == arrays[n].version)
      {
        continue;
      }
      const ArrayMessage head{ RayWorker::Array, static_cast<std::uint32_t>(n), arrays[n].version };
      std::vector<char> ofArray = messageOf(head, arrays[n].bytes);
      std::memcpy(ofArray.data() + sizeof(head), arrays[n].first, arrays[n].bytes);
      channel.send(std::move(ofArray));
      worker.sent[n] = arrays[n].version;
    }
    worker.given.push_back(message.head.tiles);
    channel.send(messageOf(message));
  }

  /// Puts rays that have come from a worker into their places. False where it has sent none.
  static bool put(
    const std::vector<char>& message, const RaysMessage& head, const Pass& pass, TracedPass& traced)
  {
    const std::size_t fields = head.fields;
    const std::size_t rays = raysOf(pass, head.tiles);
    if (head.kind != RayWorker::Rays ||
      message.size() != sizeof(head) + rays * (sizeof(RayExit) + fields * sizeof(float)) ||
      traced.gathered.size() != traced.exits.size() * fields)
    {
      return false;
    }
    const char* exits = message.data() + sizeof(head);
    const char* gathered = exits + rays * sizeof(RayExit);
    for (std::int64_t tile = head.tiles.first; tile < head.tiles.end; ++tile)
    {
      const Pass ofTile = passOfTile(pass, tile);
      const auto width = static_cast<std::size_t>(ofTile.columns);
      for (std::int64_t row = 0; row < ofTile.rows; ++row)
      {
        const auto first =
          static_cast<std::size_t>((ofTile.firstRow - pass.firstRow + row) * pass.columns +
            ofTile.firstColumn - pass.firstColumn);
        std::memcpy(traced.exits.data() + first, exits, width * sizeof(RayExit));
        exits += width * sizeof(RayExit);
        if (fields > 0)
        {
          const std::size_t bytes = width * fields * sizeof(float);
          std::memcpy(traced.gathered.data() + first * fields, gathered, bytes);
          gathered += bytes;
        }
      }
    }
    traced.crossed += head.crossed;
    traced.worstDrift = std::max(traced.worstDrift, head.worstDrift);
    return true;
  }
};

template <class Real>
TeamTracer<Real>::TeamTracer(const Medium<Real>& medium)
  : medium_(medium)
  , state_(std::make_unique<State>())
{
}

template <class Real>
TeamTracer<Real>::~TeamTracer() = default;

template <class Real>
bool TeamTracer<Real>::trace(const RayTask<Real>& task, const Pass& pass,
  const TaskVersions& versions, const std::vector<Channel*>& workers, TracedPass& traced,
  int threads, const Monitor& monitor)
{
  constexpr double secondsOfTiles =
    0.02; // that a worker is given at once, so that a pause waits for no longer
  constexpr std::size_t givenAtOnce = 2; // one is on its way while the other is traced
  constexpr int maxFailures = 2;

  State& state = *state_;
  state.locate(medium_);
  state.update(task, versions);
  TilesMessage<Real> message;
  message.head.number = State::newVersion();
  message.simd = bestSimd();
  message.pass = pass;
  message.task = task;
  forArrays(message.task,
    [&](std::size_t n, auto*& pointer)
    {
      using Value = std::remove_reference_t<decltype(*pointer)>;
      message.offsets[n] =
        pointer != nullptr ? pointer - static_cast<Value*>(state.arrays[n].first) : nowhere;
      message.versions[n] = state.arrays[n].version;
      pointer = nullptr;
    });

  TileQueue tiles = traced.tilesLeft(pass);
  std::vector<TileQueue::Tiles> returned; // that workers were given, but have not traced
  const auto takeBack = [&](typename State::Worker& worker)
  {
    returned.insert(returned.end(), worker.given.begin(), worker.given.end());
    worker.given.clear();
  };
  const auto receive = [&](Channel& channel, typename State::Worker& worker)
  {
    while (channel.hasMessage())
    {
      const std::vector<char> answer = channel.receive();
      RaysMessage head;
      if (!read(answer, head) || head.number != message.head.number || worker.given.empty())
      {
        continue; // of a trace that has failed
      }
      worker.given.pop_front();
      if (State::put(answer, head, pass, traced))
      {
        worker.failures = 0;
        worker.secondsPerTile = head.seconds / static_cast<double>(head.tiles.count());
        continue;
      }
      returned.push_back(head.tiles);
      worker.sent = {};
      ++worker.failures;
    }
    if (!channel.isOpen())
    {
      takeBack(worker);
    }
  };
  const auto give = [&](Channel& channel, typename State::Worker& worker)
  {
    while (channel.isOpen() && worker.failures < maxFailures && worker.given.size() < givenAtOnce)
    {
      const std::int64_t fair =
        tiles.left().count() / (2 * static_cast<std::int64_t>(workers.size() + 1));
      const double wanted = worker.secondsPerTile > 0 ? secondsOfTiles / worker.secondsPerTile
                                                      : 2. * threadCount(threads);
      message.head.tiles = tiles.takeBack(std::max<std::int64_t>(
        1, static_cast<std::int64_t>(std::min(wanted, static_cast<double>(fair)))));
      if (message.head.tiles.count() == 0)
      {
        return;
      }
      state.give(channel, worker, message);
    }
  };
  for (auto& [number, worker] : state.workers)
  {
    worker.given.clear(); // by a trace that has failed
  }

  Monitor watched = monitor;
  const auto exchange = [&]
  {
    for (Channel* channel : workers)
    {
      receive(*channel, state.workers[channel->number()]);
      give(*channel, state.workers[channel->number()]);
    }
  };
  watched.aborted = [&]
  {
    exchange();
    return monitor.aborted && monitor.aborted();
  };
  exchange();
  traceTiles(task, pass, tiles, traced, threads, watched);
  for (Channel* channel : workers)
  {
    typename State::Worker& worker = state.workers[channel->number()];
    receive(*channel, worker);
    while (!worker.given.empty())
    {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
      receive(*channel, worker);
    }
  }
  for (const TileQueue::Tiles& again : returned)
  {
    TileQueue ofThese(again.first, again.end);
    traceTiles(task, pass, ofThese, traced, threads, {});
  }
  return traced.keepTilesLeft(tiles, pass);
}

template class TeamTracer<float>;
template class TeamTracer<double>;

} // namespace schlieren
