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
#include <functional>
#include <map>
#include <optional>
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
    std::optional<int> capability;                  ///< of its device, once it is known
    std::deque<TileQueue::Tiles> given;             ///< tiles that have not come back
  };
  std::map<std::uint64_t, Worker> workers; ///< by the numbers of their channels
  Device lastDevice = Device::Cpu;
  int capability = 0; ///< of this process's device

  // On the devices, as far as is known.
  double secondsOnCuda = 0; ///< of this process
  double secondsPerRayTraced = 0, secondsPerRayReceived = 0;

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

  /// Sends workers the arrays of the message's task that they have not got, each array to all of them at once.
  void sendArrays(const std::vector<Channel*>& channels, const TilesMessage<Real>& message)
  {
    for (std::size_t n = 0; n < arraysOfTask; ++n)
    {
      std::vector<Channel*> lacking;
      for (Channel* channel : channels)
      {
        std::uint64_t& sent = workers[channel->number()].sent[n];
        if (message.offsets[n] != nowhere && sent != arrays[n].version)
        {
          lacking.push_back(channel);
          sent = arrays[n].version;
        }
      }
      if (lacking.empty())
      {
        continue;
      }
      Channel* first = lacking.front();
      lacking.erase(lacking.begin());
      sendPieces({ RayWorker::Array, static_cast<std::uint32_t>(n), arrays[n].version },
        arrays[n].first, arrays[n].bytes,
        [&](std::vector<char> piece) { first->sendWith(lacking, std::move(piece)); });
    }
  }

  /// How much sendArrays has to send to a worker that has nothing.
  std::size_t bytesFor(const TilesMessage<Real>& message) const
  {
    std::size_t bytes = 0;
    for (std::size_t n = 0; n < arraysOfTask; ++n)
    {
      bytes += message.offsets[n] != nowhere ? arrays[n].bytes : 0;
    }
    return bytes;
  }

  /// What workers are to do, but for the tiles. A trace that has failed leaves nothing.
  TilesMessage<Real> requestFor(const Medium<Real>& medium, const RayTask<Real>& task,
    const Pass& pass, const TaskVersions& now, Device device)
  {
    locate(medium);
    update(task, now);
    for (auto& [number, worker] : workers)
    {
      worker.given.clear();
      worker.failures = device == lastDevice ? worker.failures : 0;
      worker.secondsPerTile = device == lastDevice ? worker.secondsPerTile : 0;
    }
    lastDevice = device;
    TilesMessage<Real> message;
    message.head.number = newVersion();
    message.device = device;
    message.simd = bestSimd();
    message.pass = pass;
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

  void askDevices(const std::vector<Channel*>& channels)
  {
    capability = cudaCapability();
    for (Channel* channel : channels)
    {
      if (channel->isOpen() && !workers[channel->number()].capability)
      {
        channel->send(messageOf(DeviceMessage{}));
      }
    }
  }

  /// Puts rays that have come from a worker into their places. False where they have not what is wanted.
  static bool put(const RaysMessage& head, const char* exits, const Pass& pass, TracedPass& traced)
  {
    const std::size_t fields = head.fields;
    if (traced.gathered.size() != traced.exits.size() * fields)
    {
      return false;
    }
    const char* gathered = exits + raysOf(pass, head.tiles) * sizeof(RayExit);
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
    count(head, traced);
    return true;
  }

  /// The same of bands, whose rays are consecutive.
  static bool putBands(const RaysMessage& head, const char* exits, const Pass& pass,
    bool isWantedOnHost, TracedPass& traced)
  {
    const std::size_t fields = head.fields;
    const std::size_t rays = raysOf(passOfBands(pass, head.tiles));
    const auto first = static_cast<std::size_t>(head.tiles.first * bandRows * pass.columns);
    if (isWantedOnHost && traced.gathered.size() != traced.exits.size() * fields)
    {
      return false;
    }
    if (!isWantedOnHost)
    {
      traced.onDevice->put(first, exits, rays);
      count(head, traced);
      return true;
    }
    std::memcpy(traced.exits.data() + first, exits, rays * sizeof(RayExit));
    if (fields > 0)
    {
      std::memcpy(traced.gathered.data() + first * fields, exits + rays * sizeof(RayExit),
        rays * fields * sizeof(float));
    }
    count(head, traced);
    return true;
  }

  static void count(const RaysMessage& head, TracedPass& traced)
  {
    traced.crossed += head.crossed;
    traced.worstDrift = std::max(traced.worstDrift, head.worstDrift);
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

/// What workers do while this process traces the same pass.
template <class Real>
struct TeamTracer<Real>::Exchange
{
  using Worker = typename State::Worker;
  using Clock = std::chrono::steady_clock;

  State& state;
  const TilesMessage<Real>& request;
  const std::vector<Channel*>& workers;
  TileQueue& left;
  double firstTiles;  ///< that a worker is given whose pace is not known
  double leastOfPace; ///< of what it does in its time: no less is given, however little is left
  std::function<bool(const RaysMessage& head, const char* rays)>
    put;                                    ///< false where they are not rays
  std::vector<TileQueue::Tiles> returned{}; ///< that workers were given, but have not traced
  double seconds = 0, secondsOfRays = 0;    ///< that exchanges have taken, and rays that have come
  std::int64_t given = 0, received = 0;     ///< tiles

  static constexpr int maxFailures = 2;

  bool takesPart(const Channel& channel)
  {
    const Worker& worker = state.workers[channel.number()];
    return channel.isOpen() && worker.failures < maxFailures &&
      (request.device == Device::Cpu || worker.capability == state.capability);
  }
  std::int64_t parts()
  {
    return 1 +
      std::count_if(workers.begin(), workers.end(),
        [&](const Channel* channel) { return takesPart(*channel); });
  }

  void takeBack(Worker& worker)
  {
    returned.insert(returned.end(), worker.given.begin(), worker.given.end());
    worker.given.clear();
  }
  void receive(Channel& channel)
  {
    Worker& worker = state.workers[channel.number()];
    Clock::time_point start = Clock::now();
    while (channel.hasMessage())
    {
      const std::vector<char> answer = channel.receive();
      DeviceMessage device;
      if (read(answer, device) && device.kind == RayWorker::DeviceIs)
      {
        worker.capability = device.capability;
        continue;
      }
      RaysMessage head;
      if (!read(answer, head) || head.number != request.head.number || worker.given.empty())
      {
        continue; // of a trace that has failed
      }
      worker.given.pop_front();
      const std::size_t rays = request.device == Device::Cpu
        ? raysOf(request.pass, head.tiles)
        : raysOf(passOfBands(request.pass, head.tiles));
      if (head.kind == RayWorker::Rays &&
        answer.size() == sizeof(head) + rays * (sizeof(RayExit) + head.fields * sizeof(float)) &&
        put(head, answer.data() + sizeof(head)))
      {
        worker.failures = 0;
        worker.secondsPerTile = head.seconds / static_cast<double>(head.tiles.count());
        received += head.tiles.count();
        secondsOfRays += secondsSince(start);
        start = Clock::now();
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
  }
  void give(Channel& channel, std::int64_t processes)
  {
    constexpr double secondsOfTiles =
      0.02; // that a worker is given at once, so that a pause waits for no longer
    constexpr std::size_t givenAtOnce = 2; // one is on its way while the other is traced
    Worker& worker = state.workers[channel.number()];
    while (takesPart(channel) && worker.given.size() < givenAtOnce)
    {
      const auto fair = static_cast<double>(left.left().count() / (2 * processes));
      const double wanted =
        worker.secondsPerTile > 0 ? secondsOfTiles / worker.secondsPerTile : firstTiles;
      TilesMessage<Real> message = request;
      message.head.tiles = left.takeBack(std::max<std::int64_t>(
        1, static_cast<std::int64_t>(std::max(std::min(wanted, fair), leastOfPace * wanted))));
      if (message.head.tiles.count() == 0)
      {
        return;
      }
      given += message.head.tiles.count();
      state.sendArrays({ &channel }, message);
      worker.given.push_back(message.head.tiles);
      channel.send(messageOf(message));
    }
  }
  void operator()(bool gives)
  {
    const Clock::time_point start = Clock::now();
    std::vector<Channel*> ready;
    for (Channel* channel : workers)
    {
      receive(*channel);
      if (gives && takesPart(*channel))
      {
        ready.push_back(channel);
      }
    }
    state.sendArrays(ready, request);
    for (Channel* channel : ready)
    {
      give(*channel, static_cast<std::int64_t>(ready.size() + 1));
    }
    seconds += secondsSince(start);
  }
  /// Waits for all that workers were given.
  void finish()
  {
    for (Channel* channel : workers)
    {
      receive(*channel);
      while (!state.workers[channel->number()].given.empty())
      {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        receive(*channel);
      }
    }
  }
  static double secondsSince(Clock::time_point start)
  {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }
};

template <class Real>
bool TeamTracer<Real>::trace(const RayTask<Real>& task, const Pass& pass,
  const TaskVersions& versions, const std::vector<Channel*>& workers, TracedPass& traced,
  int threads, const Monitor& monitor)
{
  const TilesMessage<Real> request = state_->requestFor(medium_, task, pass, versions, Device::Cpu);
  TileQueue tiles = traced.tilesLeft(pass);
  Exchange exchange{ *state_, request, workers, tiles, 2. * threadCount(threads), 0,
    [&](const RaysMessage& head, const char* rays)
    { return State::put(head, rays, pass, traced); } };
  Monitor watched = monitor;
  watched.aborted = [&]
  {
    exchange(true);
    return monitor.aborted && monitor.aborted();
  };
  exchange(true);
  traceTiles(task, pass, tiles, traced, threads, watched);
  exchange.finish();
  for (const TileQueue::Tiles& again : exchange.returned)
  {
    TileQueue ofThese(again.first, again.end);
    traceTiles(task, pass, ofThese, traced, threads, {});
  }
  return traced.keepTilesLeft(tiles, pass);
}

template <class Real>
bool TeamTracer<Real>::traceOnCuda(CudaTracer<Real>& own, typename CudaTracer<Real>::Exits exits,
  const RayTask<Real>& task, const Pass& pass, const TaskVersions& versions,
  const std::vector<Channel*>& workers, TracedPass& traced, const Monitor& monitor)
{
  using Clock = typename Exchange::Clock;
  constexpr double raysOfFirst = 1 << 17;
  constexpr double leastOfPace = 0.125;  // so that a device is busy
  constexpr double bytesPerSecond = 1e9; // of a slow network

  State& state = *state_;
  const TilesMessage<Real> request = state.requestFor(medium_, task, pass, versions, Device::Cuda);
  state.askDevices(workers);
  own.begin(task, pass, exits, traced);
  TileQueue bands(0, bandsOf(pass));
  const auto raysOfBand = static_cast<double>(bandRows * pass.columns);
  constexpr auto onHost = CudaTracer<Real>::Exits::OnHost;
  Exchange exchange{ state, request, workers, bands, raysOfFirst / raysOfBand, leastOfPace,
    [&](const RaysMessage& head, const char* rays)
    { return State::putBands(head, rays, pass, exits == onHost, traced); } };

  // Workers take part where this process has traced for as long as it takes to send them the medium, and where it
  // receives rays sooner than it traces them.
  const typename Clock::time_point start = Clock::now();
  const double secondsToSend = static_cast<double>(state.bytesFor(request)) / bytesPerSecond;
  const bool areWorthIt = state.secondsPerRayReceived <= state.secondsPerRayTraced;
  const auto helps = [&]
  { return areWorthIt && state.secondsOnCuda + Exchange::secondsSince(start) >= secondsToSend; };
  Monitor watched = monitor;
  watched.aborted = [&]
  {
    exchange(helps());
    return monitor.aborted && monitor.aborted();
  };
  const auto processes = [&]() -> std::int64_t { return helps() ? exchange.parts() : 1; };
  exchange(helps());
  bool isTraced = own.traceBands(task, pass, versions, exits, bands, traced, watched, processes);
  const double seconds = Exchange::secondsSince(start) - exchange.seconds;
  state.secondsOnCuda += seconds;
  const auto ownBands = static_cast<double>(bandsOf(pass) - bands.left().count() - exchange.given);
  if (ownBands > 0)
  {
    state.secondsPerRayTraced = seconds / (ownBands * raysOfBand);
  }
  exchange.finish();
  if (exchange.received > 0)
  {
    state.secondsPerRayReceived =
      exchange.secondsOfRays / (static_cast<double>(exchange.received) * raysOfBand);
  }
  for (const TileQueue::Tiles& again : exchange.returned)
  {
    TileQueue ofThese(again.first, again.end);
    isTraced = isTraced && own.traceBands(task, pass, versions, exits, ofThese, traced, {});
  }
  if (exits == onHost)
  {
    traced.onDevice.reset();
  }
  return isTraced;
}

template <class Real>
int TeamTracer<Real>::workersOnCuda() const
{
  return static_cast<int>(std::count_if(state_->workers.begin(), state_->workers.end(),
    [&](const auto& worker)
    { return state_->capability > 0 && worker.second.capability == state_->capability; }));
}

template class TeamTracer<float>;
template class TeamTracer<double>;

} // namespace schlieren
