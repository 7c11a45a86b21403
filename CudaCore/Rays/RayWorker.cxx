// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/RayWorker.h"

#include "Device/Parallel.h"
#include "Rays/TaskArrays.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <exception>
#include <mutex>
#include <type_traits>

namespace schlieren
{

struct RayWorker::Arrays
{
  TaskArrays ofTask;

  /// What it has of them on a CUDA device.
  template <class Real>
  struct OnCuda
  {
    std::array<std::uint64_t, arraysOfTask> versions{}; ///< of those that the tracer was made of
    std::unique_ptr<CudaTracer<Real>> tracer;
    TracedPass traced; ///< its memory serves again
  };
  OnCuda<float> singlesOnCuda;
  OnCuda<double> doublesOnCuda;

  template <class Real>
  OnCuda<Real>& onCuda()
  {
    if constexpr (std::is_same_v<Real, float>)
    {
      return singlesOnCuda;
    }
    else
    {
      return doublesOnCuda;
    }
  }
  void leaveCuda()
  {
    singlesOnCuda = {};
    doublesOnCuda = {};
  }

  void keep(const std::vector<char>& message)
  {
    ArrayMessage head;
    if (read(message, head) && head.first == 0 && head.array == samplesOfTask)
    {
      leaveCuda(); // the array is of another medium
    }
    ofTask.keep(message);
  }

  /// The same on a CUDA device.
  template <class Real>
  bool traceBands(const TilesMessage<Real>& request, Channel& channel)
  {
    OnCuda<Real>& here = onCuda<Real>();
    std::array<std::uint64_t, arraysOfTask> versions{};
    const bool isTree = request.task.medium.leaves != nullptr;
    for (std::size_t n = 0; n < arraysOfTask; ++n)
    {
      const bool isOfMedium = n != 6 && (n < 6 || isTree);
      versions[n] = isOfMedium && request.offsets[n] != nowhere ? request.versions[n] : 0;
    }
    if (!here.tracer || here.versions != versions)
    {
      leaveCuda(); // first: two media at once might not fit
      if (!cudaAvailable(nullptr))
      {
        return false;
      }
      here.tracer = std::make_unique<CudaTracer<Real>>(ofTask.ofMedium(request));
      here.versions = versions;
    }
    const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    const Pass pass = passOfBands(request.pass, request.head.tiles);
    constexpr auto onHost = CudaTracer<Real>::Exits::OnHost;
    TileQueue bands(0, bandsOf(pass));
    here.tracer->begin(request.task, pass, onHost, here.traced);
    here.tracer->traceBands(request.task, pass,
      { request.versions[7], static_cast<double>(request.versions[6]) }, onHost, bands, here.traced,
      {});
    RaysMessage head;
    head.fields = static_cast<std::uint32_t>(request.task.gradients.count);
    head.number = request.head.number;
    head.tiles = request.head.tiles;
    head.crossed = here.traced.crossed;
    head.worstDrift = here.traced.worstDrift;
    head.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::size_t bytesOfExits = here.traced.exits.size() * sizeof(RayExit);
    const std::size_t bytesOfSums = here.traced.gathered.size() * sizeof(float);
    std::vector<char> answer = messageOf(head, bytesOfExits + bytesOfSums);
    char* const exits = answer.data() + sizeof(head);
    std::memcpy(exits, here.traced.exits.data(), bytesOfExits);
    if (bytesOfSums > 0)
    {
      std::memcpy(exits + bytesOfExits, here.traced.gathered.data(), bytesOfSums);
    }
    channel.send(std::move(answer));
    return true;
  }

  template <class Real>
  bool trace(const std::vector<char>& message, Channel& channel, int threads)
  {
    TilesMessage<Real> request;
    if (!read(message, request) || !ofTask.bind(request))
    {
      return false;
    }
    if (request.device == Device::Cuda)
    {
      return traceBands(request, channel);
    }
    if (!hasSimd(request.simd))
    {
      return false;
    }
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const auto fields = static_cast<std::size_t>(request.task.gradients.count);
    RaysMessage head;
    head.fields = static_cast<std::uint32_t>(fields);
    const TileQueue::Tiles& tiles = request.head.tiles;
    head.number = request.head.number;
    head.tiles = tiles;
    const std::size_t rays = raysOf(request.pass, tiles);
    std::vector<char> answer = messageOf(head, rays * (sizeof(RayExit) + fields * sizeof(float)));
    char* const exits = answer.data() + sizeof(RaysMessage);
    char* const gathered = exits + rays * sizeof(RayExit);
    std::vector<std::size_t> firstRays;
    std::size_t first = 0;
    for (std::int64_t tile = tiles.first; tile < tiles.end; ++tile)
    {
      firstRays.push_back(first);
      first += raysOf(passOfTile(request.pass, tile));
    }
    std::mutex lock; // of the head
    parallelFor(tiles.count(), 1, threads,
      [&](std::int64_t number, std::int64_t)
      {
        const Pass pass = passOfTile(request.pass, tiles.first + number);
        TracedPass traced;
        traced.resize(pass, static_cast<int>(fields));
        traceOnCpu(request.task, pass, traced, 1, {}, request.simd);
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

namespace
{

bool isSingle(const std::vector<char>& message)
{
  TilesHead request;
  return read(message, request) && request.bytesOfReal == sizeof(float);
}

/// Of the device; 0: there is none that works.
int capabilityHere()
{
  try
  {
    return cudaCapability();
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

} // namespace

void RayWorker::answer(std::vector<char> message, Channel& channel, int threads)
{
  bool isDone = true;
  try
  {
    switch (kindOf(message))
    {
      case Array:
        arrays_->keep(message);
        break;
      case AskDevice:
        channel.send(messageOf(DeviceMessage{ DeviceIs, capabilityHere() }));
        break;
      case Tiles:
        isDone = isSingle(message) ? arrays_->trace<float>(message, channel, threads)
                                   : arrays_->trace<double>(message, channel, threads);
        break;
      default:
        break;
    }
  }
  catch (const std::exception&) // there is no memory
  {
    arrays_->leaveCuda();
    isDone = kindOf(message) != Tiles;
  }
  if (!isDone)
  {
    TilesHead request;
    read(message, request);
    RaysMessage lacking;
    lacking.kind = Lacking;
    lacking.number = request.number;
    lacking.tiles = request.tiles;
    channel.send(messageOf(lacking));
  }
}

} // namespace schlieren
