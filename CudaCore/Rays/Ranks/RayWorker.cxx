// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/Ranks/RayWorker.h"

#include "Device/CudaDevice.h"
#include "Rays/Ranks/TaskArrays.h"

#include <array>
#include <cstring>
#include <exception>
#include <type_traits>
#include <utility>

namespace schlieren
{

namespace
{

/// The compute capability of the device; 0: there is none that works.
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

struct RayWorker::Arrays
{
  TaskArrays ofTask;
  TracedPass traced; ///< its memory serves again

  /// What it has of them on a CUDA device.
  template <class Real>
  struct OnCuda
  {
    std::array<std::uint64_t, arraysOfTask> versions{}; ///< of those that the tracer was made of
    std::unique_ptr<CudaTracer<Real>> tracer;
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

  std::vector<char> answer() const
  {
    const std::size_t bytes = traced.exits.size() * sizeof(RayExit);
    std::vector<char> message = messageOf(RaysHead{ traced.crossed, traced.worstDrift }, bytes);
    if (bytes > 0)
    {
      std::memcpy(message.data() + sizeof(RaysHead), traced.exits.data(), bytes);
    }
    return message;
  }

  template <class Real>
  std::vector<char> traceOnDevice(
    const TraceMessage<Real>& request, const Passes& passes, const Tiles& bands)
  {
    OnCuda<Real>& here = onCuda<Real>();
    std::array<std::uint64_t, arraysOfTask> versions{};
    for (std::size_t n = 0; n < arraysOfTask; ++n)
    {
      versions[n] = request.offsets[n] != nowhere ? request.versions[n] : 0;
    }
    if (!here.tracer || here.versions != versions)
    {
      leaveCuda(); // first: two media at once might not fit
      if (!cudaAvailable(nullptr))
      {
        throw Error("A process has no CUDA device any more.");
      }
      here.tracer = std::make_unique<CudaTracer<Real>>(ofTask.ofMedium(request));
      here.versions = versions;
    }
    traced = {};
    if (const Passes own = passes.ofBands(bands); own.rays() > 0)
    {
      here.tracer->trace(request.task, own, CudaTracer<Real>::Exits::OnHost, traced, {});
    }
    return answer();
  }

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
    return request.device == Device::Cuda
      ? traceOnDevice(
          request, passes, bandsOfProcess(request.first, request.end, process, processes))
      : traceTiles(
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
  switch (kindOf(request))
  {
    case Array:
      arrays_->keep(request);
      return {};
    case AskDevice:
      return messageOf(capabilityHere());
    default: // a task to trace
      break;
  }
  TraceHead head;
  read(request, head);
  return head.bytesOfReal == sizeof(float)
    ? arrays_->trace<float>(request, process_, processes_, threads)
    : arrays_->trace<double>(request, process_, processes_, threads);
}

} // namespace schlieren
