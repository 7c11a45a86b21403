// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/DistributedTracer.h"

#include "Rays/DistributedRays.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>
#include <utility>

namespace schlieren
{

namespace
{

/// Messages that a worker is given before it says that it has taken the first.
constexpr int givenAtOnce = 3;

/// Rays of a part that are begun before any of them has ended: enough to keep all processes busy, and few enough for a
/// pause to wait for.
constexpr std::int64_t raysPerPart = 4096;

} // namespace

template <class Real>
struct DistributedTracer<Real>::State
{
  const MediumTree<Real>& tree;
  const BrickChannels& owners;
  const std::uint64_t version = newNumber(); ///< of the tree's structure
  Traffic traffic{};

  struct Worker
  {
    bool hasTree = false;
    int given = 0; ///< messages that it has not taken
  };
  std::vector<Worker> workers;

  State(const Medium<Real>& medium, const BrickChannels& ofTree)
    : tree(*medium.tree)
    , owners(ofTree)
    , workers(ofTree.channels().size())
  {
  }

  template <class Values>
  void sendArray(Channel& channel, std::uint32_t number, const Values& values)
  {
    sendPieces({ RayWorker::Array, number, version }, values.data(),
      values.size() * sizeof(values[0]),
      [&](std::vector<char> piece) { channel.send(std::move(piece)); });
  }

  void sendStructure(Channel& channel, std::int32_t owner)
  {
    sendArray(channel, 2, tree.leavesOf(owner));
    sendArray(channel, 3, tree.roots());
    sendArray(channel, 4, tree.children());
    if (tree.gradients().count > 0)
    {
      sendArray(channel, 8, tree.gradientBricksOf(owner));
    }
  }

  /// Sends all workers what the rays of a trace need.
  void begin(const BeginMessage<Real>& trace)
  {
    std::vector<std::int32_t> addresses{ -1 }; // no worker sends this process anything as to a peer
    for (const Channel* channel : owners.channels())
    {
      addresses.push_back(channel->address());
    }
    for (std::size_t n = 0; n < workers.size(); ++n)
    {
      Channel& channel = *owners.channels()[n];
      const auto owner = static_cast<std::int32_t>(n + 1);
      if (!channel.isOpen())
      {
        throwAbsentOwner(owner);
      }
      if (!workers[n].hasTree)
      {
        sendStructure(channel, owner);
        workers[n].hasTree = true;
      }
      std::vector<char> message = messageOf(trace);
      append(addresses, message);
      traffic.own.add({ 1, static_cast<std::int64_t>(message.size()), 0 });
      channel.send(std::move(message));
      workers[n].given = 0;
    }
  }
};

template <class Real>
DistributedTracer<Real>::DistributedTracer(const Medium<Real>& medium, const BrickChannels& owners)
  : state_(std::make_unique<State>(medium, owners))
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
bool DistributedTracer<Real>::trace(const RayTask<Real>& task, const Pass& pass, TracedPass& traced,
  int threads, const Monitor& monitor, Simd simd)
{
  State& state = *state_;
  const std::vector<Channel*>& workers = state.owners.channels();
  const std::size_t count = workers.size() + 1;

  BeginMessage<Real> start;
  start.head.number = newNumber();
  start.tree = state.owners.tree();
  start.firstSample = task.medium.samples - state.tree.samples().data();
  const Carried carried = Carried::by(task);
  const std::size_t fields = carried.fields;
  start.firstGradient = fields > 0 ? task.gradients.values - state.tree.gradientValues().data() : 0;
  start.simd = simd;
  start.pass = pass;
  start.task = task;
  const std::array<const void*, arraysOfTask> arrays{ nullptr, nullptr, task.medium.leaves,
    task.medium.finder.roots, task.medium.finder.children, nullptr, nullptr, nullptr,
    fields > 0 ? task.gradients.bricks : nullptr };
  forArrays(start.task,
    [&](std::size_t n, auto*& pointer)
    {
      start.offsets[n] = arrays[n] != nullptr ? 0 : nowhere;
      start.versions[n] = state.version;
      pointer = nullptr;
    });
  state.begin(start);
  const AdvanceMessage head{ RayWorker::Advance, sizeof(Real), start.head.number };

  std::vector<TravellingRays<Real>> waiting(count, TravellingRays<Real>(carried)); // for a part
  std::int64_t underWay = 0;

  // -1: all have it.
  const auto ownerOf = [&](std::int32_t leaf) -> std::int32_t
  {
    const Leaf<Real>& here = task.medium.leaves[leaf];
    const bool hasSamples =
      here.brick != 0 || here.map >= 0 || (fields > 0 && task.gradients.bricks[leaf] != 0);
    return !here.isResident() ? ~here.brick : (hasSamples ? 0 : -1);
  };
  const auto take = [&](std::size_t from, const AdvancedRays<Real>& advanced)
  {
    for (std::size_t number = 0; number < advanced.ended.size(); ++number)
    {
      const EndedRay& one = advanced.ended[number];
      traced.exits[static_cast<std::size_t>(one.ray)] = one.exit;
      std::copy_n(advanced.gathered.data() + fields * number, fields,
        traced.gathered.data() + fields * static_cast<std::size_t>(one.ray));
    }
    underWay -= static_cast<std::int64_t>(advanced.ended.size());
    traced.worstDrift = std::max(traced.worstDrift, advanced.worstDrift);
    for (std::size_t number = 0; number < advanced.suspended.size(); ++number)
    {
      const std::int32_t owner = ownerOf(advanced.suspended.rays[number].next);
      if (owner < 0 || (owner == 0) == (from == 0)) // workers send this process its own only
      {
        throw Error(
          "A ray has been handed on to nobody: ranks disagree about the medium. Update again.");
      }
      waiting[static_cast<std::size_t>(owner)].add(advanced.suspended, number);
    }
  };
  const auto begin = [&](std::int64_t tile)
  {
    const Pass ofTile = passOfTile(pass, tile);
    constexpr std::int64_t edge = 4; // of squares of rays, which are near each other in a pack
    constexpr std::int64_t squares = tileEdge / edge, raysOfSquare = edge * edge;
    for (std::int64_t n = 0; n < tileEdge * tileEdge; ++n)
    {
      const std::int64_t square = n / raysOfSquare, inSquare = n % raysOfSquare;
      const std::int64_t column = square % squares * edge + inSquare % edge;
      const std::int64_t row = square / squares * edge + inSquare / edge;
      if (column >= ofTile.columns || row >= ofTile.rows)
      {
        continue;
      }
      const std::int64_t ray = (ofTile.firstRow - pass.firstRow + row) * pass.columns +
        ofTile.firstColumn - pass.firstColumn + column;
      RayBatch<Real, 1> batch{};
      const Entry entry = meetGrid(task, pass, ray, batch, 0);
      if (batch.fate[0] != RayFate::Left)
      {
        traced.exits[static_cast<std::size_t>(ray)] = leaveGrid(task, batch, 0, entry);
        continue;
      }
      const std::int32_t leaf = task.medium.finder.at(startOf(batch, 0));
      const std::int32_t owner = ownerOf(leaf);
      const std::int64_t part = owner >= 0 ? owner : tile % static_cast<std::int64_t>(count);
      waiting[static_cast<std::size_t>(part)].begin(ray, leaf);
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
      AdvancedMessage got;
      if (!read(answer, got) || got.number != head.number)
      {
        continue; // of a trace that has failed
      }
      AdvancedRays<Real> advanced(carried);
      if (!advanced.fromMessage(answer))
      {
        throwAbsentOwner(static_cast<std::int32_t>(n + 1));
      }
      state.workers[n].given -= got.taken;
      state.traffic.own.add({ 1, static_cast<std::int64_t>(answer.size()), 0 });
      state.traffic.amongWorkers.add(got.handedOn);
      take(n + 1, advanced);
      hasReceived = true;
    }
    if (!channel.isOpen())
    {
      throwAbsentOwner(static_cast<std::int32_t>(n + 1));
    }
    return hasReceived;
  };
  const auto give = [&](std::size_t n)
  {
    Channel& channel = *workers[n];
    typename State::Worker& worker = state.workers[n];
    while (waiting[n + 1].size() > 0 &&
      (worker.given == 0 ||
        (worker.given < givenAtOnce && waiting[n + 1].size() >= raysAtOnce<Real>(carried))))
    {
      const TravellingRays<Real> rays = waiting[n + 1].takeBack(raysAtOnce<Real>(carried));
      std::vector<char> request = messageOf(head);
      rays.write(request);
      state.traffic.own.add(
        { 1, static_cast<std::int64_t>(request.size()), static_cast<std::int64_t>(rays.size()) });
      ++worker.given;
      channel.send(std::move(request));
    }
  };
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
      take(
        0, advanceRays(task, pass, waiting[0].takeBack(raysAtOnce<Real>(carried)), threads, simd));
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
