// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/DistributedTracer.h"

#include "Medium/MediumParts.h"
#include "Rays/DistributedRays.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace schlieren
{

namespace
{

/// A channel sends messages of up to 64 kB without waiting for the other process, which may be sending, too.
constexpr std::size_t largestMessage = 60000;

/// Messages that a worker is given before it answers the first.
constexpr int givenAtOnce = 3;

/// Rays of a part that are begun before any of them has ended: enough to keep all processes busy, and few enough for a
/// pause to wait for.
constexpr std::int64_t raysPerPart = 4096;

std::uint64_t newVersion()
{
  static std::atomic<std::uint64_t> last{ 0 };
  return ++last;
}

[[noreturn]] void throwAbsent(std::size_t worker)
{
  throw Error("Rank " + std::to_string(worker + 1) +
    " does not answer, or has not enough memory for its part of the medium, which no other rank "
    "has. "
    "See what that rank has reported, or use a medium that all ranks have.");
}

} // namespace

template <class Real>
struct DistributedTracer<Real>::State
{
  const Medium<Real>& medium;
  std::optional<MediumParts<Real>> parts;
  std::vector<Leaf<Real>> leaves; ///< as this process has them
  std::uint64_t version = 0;      ///< of the parts
  Traffic traffic{};

  struct Worker
  {
    bool hasPart = false;
    int given = 0; ///< messages that it has not answered
  };
  std::map<Channel*, Worker> workers;

  explicit State(const Medium<Real>& ofMedium)
    : medium(ofMedium)
  {
  }

  void divide(std::size_t count)
  {
    const auto wanted = static_cast<std::int32_t>(count);
    if (!parts || parts->count() != wanted)
    {
      parts.emplace(*medium.tree, wanted);
      leaves = parts->leavesInTree(0);
      version = newVersion();
      workers.clear();
    }
  }

  template <class Values>
  void sendArray(Channel& channel, std::uint32_t number, const Values& values)
  {
    const ArrayMessage head{ RayWorker::Array, number, version };
    const std::size_t bytes = values.size() * sizeof(values[0]);
    std::vector<char> message = messageOf(head, bytes);
    if (bytes > 0)
    {
      std::memcpy(message.data() + sizeof(head), values.data(), bytes);
    }
    traffic.bytesOfMedium += static_cast<std::int64_t>(message.size());
    channel.send(std::move(message));
  }

  void sendPart(Channel& channel, std::int32_t owner)
  {
    const std::int64_t before = traffic.bytesOfMedium;
    const typename MediumParts<Real>::Part part = parts->part(owner);
    sendArray(channel, 0, part.samples);
    sendArray(channel, 2, part.leaves);
    sendArray(channel, 3, medium.tree->roots());
    sendArray(channel, 4, medium.tree->children());
    sendArray(channel, 5, part.gasDistances);
    sendArray(channel, 7, part.gradients);
    sendArray(channel, 8, part.gradientBricks);
    traffic.largestPart = std::max(traffic.largestPart, traffic.bytesOfMedium - before);
  }
};

template <class Real>
DistributedTracer<Real>::DistributedTracer(const Medium<Real>& medium)
  : state_(std::make_unique<State>(medium))
{
}

template <class Real>
DistributedTracer<Real>::~DistributedTracer() = default;

template <class Real>
const typename DistributedTracer<Real>::Traffic& DistributedTracer<Real>::traffic() const
{
  return state_->traffic;
}

template <class Real>
bool DistributedTracer<Real>::trace(const RayTask<Real>& task, const Pass& pass,
  const std::vector<Channel*>& workers, TracedPass& traced, int threads, const Monitor& monitor)
{
  State& state = *state_;
  const std::size_t count = workers.size() + 1;
  state.divide(count);
  const auto fields = static_cast<std::size_t>(task.gradients.count);

  AdvanceMessage<Real> message;
  message.head.kind = RayWorker::Advance;
  message.head.bytesOfReal = sizeof(Real);
  message.head.number = newVersion();
  message.pass = pass;
  message.task = task;
  const MediumTree<Real>& tree = *state.medium.tree;
  const std::array<const void*, arraysOfTask> arrays{ tree.samples().data(), nullptr,
    tree.leaves().data(), tree.roots().data(), tree.children().data(), tree.gasDistances().data(),
    nullptr, tree.gradientValues().data(), tree.gradientBricks().data() };
  forArrays(message.task,
    [&](std::size_t n, auto*& pointer)
    {
      using Value = std::remove_reference_t<decltype(*pointer)>;
      message.offsets[n] = pointer != nullptr ? pointer - static_cast<Value*>(arrays[n]) : nowhere;
      message.versions[n] = state.version;
      pointer = nullptr;
    });
  RayTask<Real> ownTask = task;
  ownTask.medium.leaves = state.leaves.data();

  const std::size_t raysAtOnce = std::max<std::size_t>(
    1, (largestMessage - sizeof(message)) / (sizeof(SuspendedRay<Real>) + fields * sizeof(float)));
  std::vector<TravellingRays<Real>> waiting(count); // for a part
  std::int64_t underWay = 0;

  const auto put = [&](std::int64_t ray, const RayExit& exit, const float* gathered)
  {
    traced.exits[static_cast<std::size_t>(ray)] = exit;
    if (gathered != nullptr)
    {
      std::copy_n(
        gathered, fields, traced.gathered.data() + static_cast<std::size_t>(ray) * fields);
    }
  };
  const auto take = [&](std::size_t from, const AdvancedRays<Real>& advanced)
  {
    for (std::size_t n = 0; n < advanced.ended.size(); ++n)
    {
      const EndedRay& one = advanced.ended[n];
      put(one.ray, one.exit, advanced.gathered.data() + n * fields);
    }
    underWay -= static_cast<std::int64_t>(advanced.ended.size());
    traced.worstDrift = std::max(traced.worstDrift, advanced.worstDrift);
    for (std::size_t n = 0; n < advanced.suspended.size(); ++n)
    {
      const SuspendedRay<Real>& ray = advanced.suspended.rays[n];
      const std::int32_t owner = state.parts->ownerOf(ray.next);
      if (owner < 0 || owner == static_cast<std::int32_t>(from))
      {
        throw Error(
          "A ray has been handed on to nobody: ranks disagree about the medium. Update again.");
      }
      waiting[static_cast<std::size_t>(owner)].add(
        ray, advanced.suspended.gathered.data() + n * fields, fields);
    }
  };
  const auto begin = [&](std::int64_t tile)
  {
    const Pass ofTile = passOfTile(pass, tile);
    for (std::int64_t n = 0; n < ofTile.columns * ofTile.rows; ++n)
    {
      const std::int64_t ray =
        (ofTile.firstRow - pass.firstRow + n / ofTile.columns) * pass.columns + ofTile.firstColumn -
        pass.firstColumn + n % ofTile.columns;
      RayBatch<Real, 1> batch{};
      const Entry entry = meetGrid(ownTask, pass, ray, batch, 0);
      if (batch.fate[0] != RayFate::Left)
      {
        put(ray, leaveGrid(ownTask, batch, 0, entry), nullptr);
        continue;
      }
      const std::int32_t leaf = ownTask.medium.finder.at(startOf(batch, 0));
      const std::int32_t owner = state.parts->ownerOf(leaf);
      const std::int64_t part = owner >= 0 ? owner : tile % static_cast<std::int64_t>(count);
      waiting[static_cast<std::size_t>(part)].begin(ray, leaf, fields);
      ++traced.crossed;
      ++underWay;
    }
  };
  const auto receive = [&](std::size_t n)
  {
    Channel& channel = *workers[n];
    bool hasReceived = false;
    while (channel.hasMessage())
    {
      const std::vector<char> answer = channel.receive();
      AdvancedMessage head;
      if (!read(answer, head) || head.number != message.head.number)
      {
        RaysMessage lacking;
        if (read(answer, lacking) && lacking.kind == RayWorker::Lacking &&
          lacking.number == message.head.number)
        {
          throwAbsent(n);
        }
        continue; // of a trace that has failed
      }
      AdvancedRays<Real> advanced;
      if (!advanced.fromMessage(answer, fields))
      {
        state.workers[&channel].hasPart = false;
        throwAbsent(n);
      }
      --state.workers[&channel].given;
      ++state.traffic.messages;
      state.traffic.bytes += static_cast<std::int64_t>(answer.size());
      take(n + 1, advanced);
      hasReceived = true;
    }
    if (!channel.isOpen())
    {
      throwAbsent(n);
    }
    return hasReceived;
  };
  const auto give = [&](std::size_t n)
  {
    Channel& channel = *workers[n];
    typename State::Worker& worker = state.workers[&channel];
    while (waiting[n + 1].size() > 0 &&
      (worker.given == 0 || (worker.given < givenAtOnce && waiting[n + 1].size() >= raysAtOnce)))
    {
      if (!worker.hasPart)
      {
        state.sendPart(channel, static_cast<std::int32_t>(n + 1));
        worker.hasPart = true;
      }
      const TravellingRays<Real> rays = waiting[n + 1].takeBack(raysAtOnce, fields);
      message.head.rays = static_cast<std::int64_t>(rays.size());
      std::vector<char> request = messageOf(message);
      rays.write(request);
      ++state.traffic.messages;
      state.traffic.bytes += static_cast<std::int64_t>(request.size());
      state.traffic.states += message.head.rays;
      ++worker.given;
      channel.send(std::move(request));
    }
  };
  for (Channel* channel : workers)
  {
    state.workers[channel].given = 0; // by a trace that has failed
  }

  TileQueue tiles = traced.tilesLeft(pass);
  const TileQueue::Tiles all = tiles.left();
  const std::int64_t most = raysPerPart * static_cast<std::int64_t>(count);
  bool isStopped = false;
  for (;;)
  {
    while (!isStopped && underWay < most && tiles.left().count() > 0)
    {
      begin(tiles.takeFront().first);
    }
    bool isIdle = true;
    for (std::size_t n = 0; n < workers.size(); ++n)
    {
      isIdle = !receive(n) && isIdle;
      give(n);
    }
    if (waiting[0].size() > 0)
    {
      take(0, advanceRays(ownTask, pass, waiting[0].takeBack(raysAtOnce, fields), threads));
      isIdle = false;
    }
    if (underWay == 0 && (isStopped || tiles.left().count() == 0))
    {
      break;
    }
    if (isIdle)
    {
      std::this_thread::sleep_for(std::chrono::microseconds(20));
    }
    if (monitor.progress)
    {
      monitor.progress(static_cast<double>(tiles.left().first) /
        static_cast<double>(std::max<std::int64_t>(1, all.end)));
    }
    isStopped =
      isStopped || (monitor.aborted && monitor.aborted()) || (monitor.paused && monitor.paused());
  }
  return traced.keepTilesLeft(tiles, pass);
}

template class DistributedTracer<float>;
template class DistributedTracer<double>;

} // namespace schlieren
