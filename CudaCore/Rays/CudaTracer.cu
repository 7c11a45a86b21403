// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/CudaTracer.h"

#include "Device/CudaDevice.h"
#include "Rays/CudaMarch.h"
#include "Rays/CudaParts.h"
#include "Rays/CudaTracerMemory.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <type_traits>
#include <vector>

namespace schlieren
{

namespace
{

/// Blocks for so many rows of a pass.
dim3 blocksOf(const Pass& pass, std::int64_t rows)
{
  return { static_cast<unsigned>((pass.columns + blockColumns - 1) / blockColumns),
    static_cast<unsigned>((rows + blockRows - 1) / blockRows) };
}

/// How many rows of blocks a launch should have.
std::int64_t blockRowsOf(const Pass& pass, const LaunchPace& pace)
{
  constexpr std::int64_t most = 65535; // along a grid's second axis
  return std::clamp<std::int64_t>(pace.rays() / pass.columns / blockRows, 1, most);
}

void addTotals(const MarchTotals& totals, TracedPass& traced)
{
  double worstDrift = 0;
  std::memcpy(&worstDrift, &totals.worstDrift, sizeof(worstDrift));
  traced.crossed += static_cast<std::int64_t>(totals.crossed);
  traced.worstDrift = std::max(traced.worstDrift, worstDrift);
}

/// The next of the parts that rays wait for: forwards, and again from the first one for rays that have come back.
std::int32_t nextPart(const std::vector<unsigned long long>& waiting, std::int32_t part)
{
  const auto count = static_cast<std::int32_t>(waiting.size());
  for (std::int32_t ahead = 1; ahead <= count; ++ahead)
  {
    const std::int32_t next = (part + ahead) % count;
    if (waiting[static_cast<std::size_t>(next)] > 0)
    {
      return next;
    }
  }
  return TreeParts::none;
}

} // namespace

bool cudaAvailable(std::string* reason)
{
  int devices = 0;
  const cudaError_t status = cudaGetDeviceCount(&devices);
  if (status == cudaSuccess && devices > 0)
  {
    checkCuda(cudaSetDevice(chosenCudaDevice(devices)), "Choosing a device");
    return true;
  }
  cudaGetLastError();
  if (reason != nullptr)
  {
    *reason = status == cudaSuccess ? "no CUDA device was found" : cudaGetErrorString(status);
  }
  return false;
}

int cudaCapability()
{
  int device = 0, first = 0, second = 0;
  if (!cudaAvailable(nullptr))
  {
    return 0;
  }
  checkCuda(cudaGetDevice(&device), "Asking for the device");
  checkCuda(cudaDeviceGetAttribute(&first, cudaDevAttrComputeCapabilityMajor, device),
    "Asking for the device");
  checkCuda(cudaDeviceGetAttribute(&second, cudaDevAttrComputeCapabilityMinor, device),
    "Asking for the device");
  return 10 * first + second;
}

template <class Real>
MediumArrays<Real> MediumArrays<Real>::of(const Medium<Real>& medium)
{
  const auto arrayOf = [](const auto& values)
  {
    using T = std::decay_t<decltype(values[0])>;
    return Array<T>{ values.data(), values.size() };
  };
  MediumArrays arrays;
  arrays.view = medium.view();
  arrays.solid = arrayOf(medium.solid);
  if (!medium.tree)
  {
    arrays.samples = arrayOf(medium.volume.samples);
    return arrays;
  }
  const MediumTree<Real>& tree = *medium.tree;
  arrays.samples = arrayOf(tree.samples());
  arrays.leaves = arrayOf(tree.leaves());
  arrays.roots = arrayOf(tree.roots());
  arrays.children = arrayOf(tree.children());
  arrays.gasDistances = arrayOf(tree.gasDistances());
  if (const FieldGradientsView ofFields = tree.gradients(); ofFields.count > 0)
  {
    arrays.gradients = arrayOf(tree.gradientValues());
    arrays.gradientBricks = arrayOf(tree.gradientBricks());
    arrays.firstGradient = ofFields.values - arrays.gradients.first;
  }
  return arrays;
}

template <class Real>
CudaTracer<Real>::CudaTracer(const Medium<Real>& medium, std::size_t memory)
  : CudaTracer(MediumArrays<Real>::of(medium), memory)
{
}

template <class Real>
CudaTracer<Real>::CudaTracer(const MediumArrays<Real>& medium, std::size_t memory)
  : medium_(medium)
  , limit_(memory)
  , memory_(std::make_unique<DeviceMemory>())
{
  const std::size_t bytes = CudaParts<Real>::bytesOfStructure(medium) +
    CudaParts<Real>::bytesOfBricks(medium) + medium.gradients.count * sizeof(float);
  if (medium.leaves.count == 0 || bytes <= std::min(availableOnCuda(), memory))
  {
    memory_->send(medium);
  }
}

template <class Real>
CudaTracer<Real>::~CudaTracer() = default;

template <class Real>
bool CudaTracer<Real>::hasAll() const
{
  return memory_->isSent;
}

template <class Real>
bool CudaTracer<Real>::trace(const RayTask<Real>& task, const Pass& pass,
  const TaskVersions& versions, Exits exits, TracedPass& traced, const Monitor& monitor)
{
  begin(task, pass, exits, traced);
  TileQueue bands(0, bandsOf(pass));
  const bool isTraced = traceBands(task, pass, versions, exits, bands, traced, monitor);
  if (exits == Exits::OnHost)
  {
    traced.onDevice.reset();
  }
  return isTraced;
}

template <class Real>
void CudaTracer<Real>::begin(
  const RayTask<Real>& task, const Pass& pass, Exits exits, TracedPass& traced) const
{
  checkCuda(cudaSetDevice(memory_->device), "Choosing a device"); // of this thread
  const auto rays = static_cast<std::size_t>(pass.columns * pass.rows);
  std::unique_ptr<CudaPass> there = std::move(traced.onDevice); // its memory serves again
  if (!there || there->size() != rays)
  {
    there.reset();
    there = std::make_unique<CudaPass>(rays);
  }
  if (exits == Exits::OnHost)
  {
    traced.resize(pass, task.gradients.count);
    traced.crossed = 0;
    traced.worstDrift = 0;
  }
  else
  {
    traced = {};
  }
  traced.onDevice = std::move(there);
}

template <class Real>
bool CudaTracer<Real>::traceBands(const RayTask<Real>& task, const Pass& pass,
  const TaskVersions& versions, Exits exits, TileQueue& bands, TracedPass& traced,
  const Monitor& monitor, const std::function<std::int64_t()>& processes)
{
  static_assert(bandRows == blockRows);
  const int fields = exits == Exits::OnHost ? task.gradients.count : 0;
  if (!hasAll())
  {
    if (!samplesBeyond(task.kernel) && fields == 0)
    {
      return traceInParts(task, pass, exits, bands, traced, monitor);
    }
    memory_->send(medium_);
  }
  parts_ = 1;
  const RayTask<Real> onDevice = memory_->upload(task, versions);
  const auto rays = static_cast<std::size_t>(pass.columns * pass.rows);
  const CudaPass* there = traced.onDevice.get();
  const std::size_t sums = rays * static_cast<std::size_t>(fields);
  const std::unique_ptr<CudaBuffer<float>> gathered =
    fields > 0 ? std::make_unique<CudaBuffer<float>>(sums) : nullptr;
  memory_->clearTotals();
  memory_->findPace(task, fields);

  /// Some rows, traced in a lane.
  struct Launch
  {
    typename DeviceMemory::Lane* lane;
    std::int64_t firstRow, rows;
  };
  /// Of the next bands, if there are any.
  const auto launch = [&](std::int64_t number) -> std::optional<Launch>
  {
    std::int64_t wanted = blockRowsOf(pass, *memory_->pace);
    if (const std::int64_t parts = processes ? processes() : 1; parts > 1)
    {
      constexpr std::int64_t least = 8; // of what it does in its time, so that the device is busy
      const std::int64_t fair = bands.left().count() / (2 * parts);
      wanted = std::clamp<std::int64_t>(fair, (wanted + least - 1) / least, wanted);
    }
    const TileQueue::Tiles taken = bands.takeFront(wanted);
    if (taken.count() == 0)
    {
      return {};
    }
    const std::int64_t firstRow = taken.first * bandRows;
    const std::int64_t rows = std::min(pass.rows, taken.end * bandRows) - firstRow;
    auto& lane = memory_->lanes[static_cast<std::size_t>(number % 2)];
    lane.begin.record(lane.stream);
    visitScheme(task.kernel.interpolation,
      [&](auto scheme)
      {
        launchMarch<decltype(scheme)>(onDevice, fields > 0,
          { pass, firstRow, there->exits(), gathered ? gathered->data() : nullptr,
            lane.totals.data() },
          blocksOf(pass, rows), lane.stream.get());
      });
    checkCuda(cudaGetLastError(), "Starting the ray kernel");
    lane.end.record(lane.stream);
    return { { &lane, firstRow, rows } };
  };
  /// Waits for the launch.
  const auto fetch = [&](const Launch& launched)
  {
    auto& lane = *launched.lane;
    const auto count = static_cast<std::size_t>(launched.rows * pass.columns);
    if (exits == Exits::OnHost)
    {
      const auto first = static_cast<std::size_t>(launched.firstRow * pass.columns);
      copyRays(traced.exits.data() + first, there->exits() + first, count, lane.stream);
      if (fields > 0)
      {
        const auto perRay = static_cast<std::size_t>(fields);
        copyRays(traced.gathered.data() + first * perRay, gathered->data() + first * perRay,
          count * perRay, lane.stream);
      }
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
      const std::int64_t toCome =
        std::min(pass.rows, bands.left().end * bandRows) - current->firstRow - current->rows;
      monitor.progress(1 - static_cast<double>(toCome) / static_cast<double>(pass.rows));
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
  return true;
}

template <class Real>
bool CudaTracer<Real>::traceInParts(const RayTask<Real>& task, const Pass& pass, Exits exits,
  TileQueue& bands, TracedPass& traced, const Monitor& monitor)
{
  using State = SuspendedRay<Real>;
  using Count = unsigned long long;
  const std::size_t raysOfBand = static_cast<std::size_t>(bandRows * pass.columns);
  const std::size_t bytesOfPass =
    static_cast<std::size_t>(pass.rows * pass.columns) * sizeof(RayExit);
  const std::size_t besides =
    nextPassAndFilms * bytesOfPass + CudaParts<Real>::bytesOfStructure(medium_);
  const std::size_t available = availableOnCuda();
  const std::size_t memory = std::min(limit_, available - std::min(available, besides));
  // Rays that wait at the same time: the fewer there are, the more often all parts have to be sent.
  const std::size_t bytesOfBand = raysOfBand * sizeof(State);
  const std::int64_t bandsAtOnce =
    std::clamp<std::int64_t>(static_cast<std::int64_t>(memory / 4 / bytesOfBand), 1, bandsOf(pass));
  const CudaBuffer<State> states(static_cast<std::size_t>(bandsAtOnce) * raysOfBand);
  // With more parts than that the device would do little but receive them.
  constexpr std::size_t mostParts = 256;
  CudaParts<Real> parts(medium_, task.light.perLength,
    std::max(memory - std::min(memory, static_cast<std::size_t>(bandsAtOnce) * bytesOfBand),
      CudaParts<Real>::bytesOfBricks(medium_) / mostParts));
  parts_ = parts.count();

  auto& lane = memory_->lanes[0];
  const auto countOfParts = static_cast<std::size_t>(parts.count());
  const CudaBuffer<Count> counts(
    countOfParts + 1); // of rays that wait for each part, and that have advanced
  Count* const advanced = counts.data() + countOfParts;
  std::vector<Count> waiting(countOfParts);
  RayTask<Real> onDevice = task;
  onDevice.map = {};
  onDevice.gradients = {};
  memory_->clearTotals();
  memory_->findPace(task, 0);

  const auto clear = [&](std::size_t first, std::size_t count)
  { checkCuda(cudaMemset(counts.data() + first, 0, count * sizeof(Count)), "Counting rays"); };
  /// Takes rays of some rows through the part that is there. False if aborted.
  const auto advance = [&](std::int64_t firstRow, std::int64_t endRow, bool areNew)
  {
    const std::int64_t firstRay = firstRow * pass.columns;
    for (std::int64_t row = firstRow; row < endRow;)
    {
      const std::int64_t end =
        std::min(endRow, row + blockRowsOf(pass, *memory_->pace) * blockRows);
      clear(countOfParts, 1);
      lane.begin.record(lane.stream);
      visitScheme(task.kernel.interpolation,
        [&](auto scheme)
        {
          launchAdvance<decltype(scheme)>(onDevice,
            AdvancedRows<Real>{ pass, row, end, firstRay, states.data(), traced.onDevice->exits(),
              lane.totals.data(), advanced, counts.data(), areNew },
            blocksOf(pass, end - row), lane.stream.get());
        });
      checkCuda(cudaGetLastError(), "Starting the ray kernel");
      lane.end.record(lane.stream);
      Count ofLaunch = 0;
      copyRays(&ofLaunch, advanced, 1, lane.stream);
      lane.stream.wait("Tracing rays");
      const std::int64_t launched = (end - row) * pass.columns;
      if (constexpr Count most = 8; ofLaunch * most >= static_cast<Count>(launched))
      {
        memory_->pace->add(launched, static_cast<std::int64_t>(ofLaunch),
          CudaEvent::secondsBetween(lane.begin, lane.end));
      }
      row = end;
      if (monitor.aborted && monitor.aborted())
      {
        return false;
      }
    }
    return true;
  };
  double progress = 0;
  for (;;)
  {
    const TileQueue::Tiles taken = bands.takeFront(bandsAtOnce);
    if (taken.count() == 0)
    {
      break;
    }
    const std::int64_t firstRow = taken.first * bandRows;
    const std::int64_t endRow = std::min(pass.rows, taken.end * bandRows);
    clear(0, countOfParts);
    bool areNew = true;
    for (std::int32_t part = 0; part != TreeParts::none;)
    {
      parts.load(part);
      onDevice.medium = parts.view();
      clear(static_cast<std::size_t>(part), 1); // these continue now
      if (!advance(firstRow, endRow, areNew))
      {
        return false;
      }
      areNew = false;
      copyRays(waiting.data(), counts.data(), countOfParts, lane.stream);
      lane.stream.wait("Tracing rays");
      const double done = static_cast<double>(part + 1) / static_cast<double>(countOfParts);
      progress = std::max(progress,
        (static_cast<double>(firstRow) + done * static_cast<double>(endRow - firstRow)) /
          static_cast<double>(pass.rows));
      if (monitor.progress)
      {
        monitor.progress(progress);
      }
      part = nextPart(waiting, part);
    }
    if (exits == Exits::OnHost)
    {
      const auto first = static_cast<std::size_t>(firstRow * pass.columns);
      copyRays(traced.exits.data() + first, traced.onDevice->exits() + first,
        static_cast<std::size_t>((endRow - firstRow) * pass.columns), lane.stream);
      lane.stream.wait("Fetching rays");
    }
  }
  addTotals(lane.fetchTotals(), traced);
  return true;
}

template class CudaTracer<float>;
template class CudaTracer<double>;

} // namespace schlieren
