// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/Cuda/CudaTracer.h"

#include "Device/CudaDevice.h"
#include "Rays/Cuda/CudaMarch.h"
#include "Rays/Cuda/CudaTracerMemory.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <type_traits>

namespace schlieren
{

namespace
{

/// Blocks for so many bands.
dim3 blocksOf(const Passes& passes, std::int64_t bands)
{
  return { static_cast<unsigned>((passes.columns() + blockColumns - 1) / blockColumns),
    static_cast<unsigned>(bands) };
}

/// How many bands a launch should have.
std::int64_t bandsAtOnce(const Passes& passes, const LaunchPace& pace)
{
  constexpr std::int64_t most = 65535; // along a grid's second axis
  return std::clamp<std::int64_t>(pace.rays() / passes.columns() / bandRows, 1, most);
}

void addTotals(const MarchTotals& totals, TracedPass& traced)
{
  double worstDrift = 0;
  std::memcpy(&worstDrift, &totals.worstDrift, sizeof(worstDrift));
  traced.crossed += static_cast<std::int64_t>(totals.crossed);
  traced.worstDrift = std::max(traced.worstDrift, worstDrift);
}

} // namespace

template <class Real>
CudaTracer<Real>::CudaTracer(const Medium<Real>& medium)
  : memory_(std::make_unique<DeviceMemory>(medium))
{
}

template <class Real>
CudaTracer<Real>::~CudaTracer() = default;

template <class Real>
bool CudaTracer<Real>::trace(const RayTask<Real>& task, const Passes& passes, Exits exits,
  TracedPass& traced, const Monitor& monitor)
{
  checkCuda(cudaSetDevice(memory_->device), "Choosing a device"); // of this thread
  std::unique_ptr<CudaPass> there = std::move(traced.onDevice);   // its memory serves again
  if (!there || there->size() != passes.rays())
  {
    there.reset();
    there = std::make_unique<CudaPass>(passes.rays());
  }
  if (exits == Exits::OnHost)
  {
    traced.resize(passes);
    traced.crossed = 0;
    traced.worstDrift = 0;
  }
  else
  {
    traced = {};
  }
  RayTask<Real> onDevice = task;
  onDevice.medium = memory_->view;
  const CudaBuffer<PlacedPass> passesThere(
    passes.all().data(), passes.all().size(), "Copying the passes");
  memory_->clearTotals();
  memory_->findPace(task);

  /// Some bands, traced in a lane.
  struct Launch
  {
    typename DeviceMemory::Lane* lane;
    std::size_t firstRay, endRay;
  };
  std::int64_t nextBand = 0;
  /// Launches the next bands, if there are any.
  const auto launch = [&](std::int64_t number) -> std::optional<Launch>
  {
    if (nextBand >= passes.bands())
    {
      return {};
    }
    const std::int64_t firstBand = nextBand;
    nextBand = std::min(passes.bands(), nextBand + bandsAtOnce(passes, *memory_->pace));
    auto& lane = memory_->lanes[static_cast<std::size_t>(number % 2)];
    lane.begin.record(lane.stream);
    visitScheme(task.kernel.interpolation,
      [&](auto scheme)
      {
        launchMarch<decltype(scheme)>(onDevice,
          { passesThere.data(), static_cast<int>(passes.all().size()), firstBand, there->exits(),
            lane.totals.data() },
          blocksOf(passes, nextBand - firstBand), lane.stream.get());
      });
    checkCuda(cudaGetLastError(), "Starting the ray kernel");
    lane.end.record(lane.stream);
    return { { &lane, passes.raysBefore(firstBand), passes.raysBefore(nextBand) } };
  };
  /// Waits for the launch.
  const auto fetch = [&](const Launch& launched)
  {
    auto& lane = *launched.lane;
    const std::size_t first = launched.firstRay, count = launched.endRay - first;
    if (exits == Exits::OnHost)
    {
      copyRays(traced.exits.data() + first, there->exits() + first, count, lane.stream);
    }
    const auto crossed = static_cast<std::int64_t>(lane.fetchTotals().crossed);
    memory_->pace->add(static_cast<std::int64_t>(count), crossed - lane.crossed,
      CudaEvent::secondsBetween(lane.begin, lane.end));
    lane.crossed = crossed;
  };

  std::int64_t launches = 0;
  std::optional<Launch> current = launch(launches++);
  while (current)
  {
    const std::optional<Launch> next = launch(launches++); // runs while this one's rays are copied
    fetch(*current);
    if (monitor.progress)
    {
      monitor.progress(static_cast<double>(current->endRay) / static_cast<double>(passes.rays()));
    }
    if (monitor.aborted && monitor.aborted())
    {
      for (const auto& lane : memory_->lanes)
      {
        lane.stream.wait("Tracing rays"); // which would write to what comes next
      }
      return false;
    }
    current = next;
  }
  for (const auto& lane : memory_->lanes)
  {
    addTotals(lane.fetchTotals(), traced);
  }
  if (exits == Exits::OnDevice)
  {
    traced.onDevice = std::move(there);
  }
  return true;
}

template class CudaTracer<float>;
template class CudaTracer<double>;

} // namespace schlieren
