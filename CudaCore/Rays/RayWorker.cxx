// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/RayWorker.h"

#include "Device/Parallel.h"
#include "Device/UninitialisedAllocator.h"
#include "Rays/DistributedRays.h"
#include "Rays/TeamMessages.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>

namespace schlieren
{

struct RayWorker::Arrays
{
  struct Cached
  {
    std::uint64_t version = 0; ///< 0: there is none, or not all of it
    std::uint64_t coming = 0;  ///< version of which there are `known` bytes
    std::size_t known = 0;
    std::vector<char, UninitialisedAllocator<char>> bytes;
  };
  std::array<Cached, arraysOfTask> cached;

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

  /// A piece of an array. Where there is no memory for it, it is not there.
  void keep(const std::vector<char>& message)
  {
    ArrayMessage head;
    if (!read(message, head) || head.array >= arraysOfTask)
    {
      return;
    }
    Cached& array = cached[head.array];
    if (head.first == 0)
    {
      if (head.array == samplesOfTask) // of another medium
      {
        tree = 0;
        singles.reset();
        doubles.reset();
        leaveCuda();
      }
      array = {}; // first: two at once might not fit
      try
      {
        array.bytes.resize(static_cast<std::size_t>(head.bytes));
        array.coming = head.version;
      }
      catch (const std::exception&)
      {
        return;
      }
    }
    const std::size_t count = message.size() - sizeof(head);
    if (array.coming == head.version && array.known == head.first &&
      count <= array.bytes.size() - array.known)
    {
      std::copy_n(message.begin() + sizeof(head), count,
        array.bytes.begin() + static_cast<std::ptrdiff_t>(array.known));
      array.known += count;
      array.version = array.known == array.bytes.size() ? head.version : 0;
    }
  }

  /// What it has of a tree that is divided.
  std::uint64_t tree = 0; ///< 0: nothing, or not all of it
  std::uint64_t puts = 0; ///< messages with bricks of it
  std::optional<PartOfTree<float>> singles;
  std::optional<PartOfTree<double>> doubles;

  template <class Real>
  std::optional<PartOfTree<Real>>& part()
  {
    if constexpr (std::is_same_v<Real, float>)
    {
      return singles;
    }
    else
    {
      return doubles;
    }
  }

  template <class Real>
  void put(const BricksMessage& head, const std::vector<char>& message)
  {
    const bool isFirst = head.number == 0;
    if (isFirst)
    {
      cached = {};
      singles.reset();
      doubles.reset();
      part<Real>().emplace(head.layout);
    }
    const bool isNext = isFirst || (tree == head.tree && puts == head.number);
    tree = 0; // where there is no memory
    if (isNext && part<Real>() &&
      part<Real>()->put(message.data() + sizeof(head), message.size() - sizeof(head)))
    {
      tree = head.tree;
      puts = head.number + 1;
    }
  }

  /// Answers SumUp and FetchBricks.
  template <class Real>
  bool find(
    const BricksMessage& head, const std::vector<char>& message, Channel& channel, int threads)
  {
    if (tree != head.tree || !part<Real>())
    {
      return false;
    }
    const PartOfTree<Real>& own = *part<Real>();
    const auto itemsOf = [&](auto item)
    {
      std::vector<decltype(item)> items((message.size() - sizeof(head)) / sizeof(item));
      std::memcpy(items.data(), message.data() + sizeof(head), items.size() * sizeof(item));
      return items;
    };
    AdvancedMessage found;
    found.kind = Found;
    found.number = head.number;
    std::vector<char> answer = messageOf(found);
    const auto append = [&](const auto& values)
    {
      const char* first = reinterpret_cast<const char*>(values.data());
      answer.insert(answer.end(), first, first + values.size() * sizeof(values[0]));
    };
    if (head.kind == SumUp)
    {
      std::vector<LeafSums> sums;
      if (!own.sumUp(itemsOf(LeafSegment{}), sums, threads))
      {
        return false;
      }
      append(sums);
    }
    else
    {
      std::vector<char> samples;
      if (!own.fetch(itemsOf(std::int32_t{}), samples))
      {
        return false;
      }
      append(samples);
    }
    channel.send(std::move(answer));
    return true;
  }

  /// Makes the task's pointers point to the arrays. False where one is not there.
  template <class Request>
  bool bind(Request& request) const
  {
    bool isComplete = true;
    forArrays(request.task,
      [&](std::size_t n, auto*& pointer)
      {
        using Value = std::remove_reference_t<decltype(*pointer)>;
        pointer = nullptr;
        if (request.offsets[n] != nowhere)
        {
          isComplete = isComplete && cached[n].version == request.versions[n];
        }
        if (request.offsets[n] != nowhere && isComplete)
        {
          const void* first = cached[n].bytes.data();
          pointer = static_cast<Value*>(first) + request.offsets[n];
        }
      });
    return isComplete;
  }

  template <class Real>
  MediumArrays<Real> arraysOf(const TilesMessage<Real>& request) const
  {
    const auto set = [&](std::size_t n, auto& array)
    {
      if (request.offsets[n] != nowhere)
      {
        using Value = std::remove_reference_t<decltype(*array.first)>;
        const void* first = cached[n].bytes.data();
        array.first = static_cast<Value*>(first);
        array.count = cached[n].bytes.size() / sizeof(Value);
      }
    };
    MediumArrays<Real> arrays;
    arrays.view = request.task.medium;
    set(0, arrays.samples);
    set(1, arrays.solid);
    if (request.task.medium.leaves != nullptr)
    {
      set(2, arrays.leaves);
      set(3, arrays.roots);
      set(4, arrays.children);
      set(5, arrays.gasDistances);
      set(7, arrays.gradients);
      set(8, arrays.gradientBricks);
      arrays.firstGradient = request.offsets[7] != nowhere ? request.offsets[7] : 0;
    }
    return arrays;
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
      here.tracer = std::make_unique<CudaTracer<Real>>(arraysOf(request));
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
    if (!read(message, request) || !bind(request))
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

  /// Takes rays through the leaves that are here.
  template <class Real>
  bool advance(const std::vector<char>& message, Channel& channel, int threads)
  {
    AdvanceMessage<Real> request;
    const std::optional<PartOfTree<Real>>& own = part<Real>();
    if (!read(message, request) || !hasSimd(request.simd) || !bind(request) ||
      request.head.tree != tree || !own)
    {
      return false;
    }
    request.task.medium.samples = own->samples().data() + request.head.firstSample;
    request.task.medium.gasDistances = own->gasDistances().data() + request.head.firstSample;
    TravellingRays<Real> rays;
    const auto count = static_cast<std::size_t>(request.head.rays);
    if (rays.read(message, sizeof(request), count) != message.size())
    {
      return false;
    }
    const AdvancedRays<Real> advanced =
      advanceRays(request.task, request.pass, std::move(rays), threads, request.simd);
    channel.send(advanced.toMessage(request.head.number));
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
    arrays_->keep(message);
    return;
  }
  if (kindOf(message) == AskDevice)
  {
    DeviceMessage device{ DeviceIs, 0 };
    try
    {
      device.capability = cudaCapability();
    }
    catch (const std::exception&) // it does not work
    {
    }
    channel.send(messageOf(device));
    return;
  }
  TilesHead request;
  BricksMessage ofBricks;
  const bool isOfBricks =
    read(message, ofBricks) && ofBricks.kind >= PutBricks && ofBricks.kind <= FetchBricks;
  if (!isOfBricks &&
    (!read(message, request) || (request.kind != Tiles && request.kind != Advance)))
  {
    return;
  }
  const bool isSingle = (isOfBricks ? ofBricks.bytesOfReal : request.bytesOfReal) == sizeof(float);
  bool isTraced = false;
  try
  {
    if (isOfBricks && ofBricks.kind == PutBricks)
    {
      isSingle ? arrays_->put<float>(ofBricks, message) : arrays_->put<double>(ofBricks, message);
      return;
    }
    if (isOfBricks)
    {
      request.number = ofBricks.number;
      isTraced = isSingle ? arrays_->find<float>(ofBricks, message, channel, threads)
                          : arrays_->find<double>(ofBricks, message, channel, threads);
    }
    else if (request.kind == Tiles)
    {
      isTraced = isSingle ? arrays_->trace<float>(message, channel, threads)
                          : arrays_->trace<double>(message, channel, threads);
    }
    else
    {
      isTraced = isSingle ? arrays_->advance<float>(message, channel, threads)
                          : arrays_->advance<double>(message, channel, threads);
    }
  }
  catch (const std::exception&) // there is no memory
  {
    arrays_->leaveCuda();
  }
  if (!isTraced && kindOf(message) != PutBricks)
  {
    RaysMessage lacking;
    lacking.kind = Lacking;
    lacking.number = request.number;
    lacking.tiles = request.tiles;
    channel.send(messageOf(lacking));
  }
}

} // namespace schlieren
