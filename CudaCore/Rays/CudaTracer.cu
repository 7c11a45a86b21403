// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/CudaTracer.h"

#include "Device/CudaBuffer.h"
#include "Device/CudaDevice.h"
#include "Rays/CudaMarch.h"
#include "Rays/LaunchPace.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <tuple>
#include <type_traits>

namespace schlieren
{

namespace
{

template <class T>
using Buffer = CudaBuffer<T>;
using Stream = CudaStream;
using Event = CudaEvent;

template <class T>
void copy(T* toHost, const T* fromDevice, std::size_t count, const Stream& stream)
{
  checkCuda(
    cudaMemcpyAsync(toHost, fromDevice, count * sizeof(T), cudaMemcpyDeviceToHost, stream.get()),
    "Fetching rays");
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
struct CudaTracer<Real>::DeviceMemory
{
  explicit DeviceMemory(const MediumArrays<Real>& medium)
    : view(medium.view)
    , samples(medium.samples.first, medium.samples.count, "Copying the medium")
  {
    view.samples = samples.data() + (view.samples - medium.samples.first);
    if (medium.leaves.count > 0)
    {
      tree = std::make_unique<Tree>(medium);
      const std::int64_t ghost = view.samples - samples.data();
      view.leaves = tree->leaves.data();
      view.finder.roots = tree->roots.data();
      view.finder.children = tree->children.data();
      view.gasDistances =
        view.gasDistances != nullptr ? tree->gasDistances->data() + ghost : nullptr;
    }
    if (medium.solid.count > 0)
    {
      solid = std::make_unique<Buffer<std::uint32_t>>(
        medium.solid.first, medium.solid.count, "Copying the solids");
      view.solid = solid->data();
    }
  }

  static int currentDevice()
  {
    int device = 0;
    checkCuda(cudaGetDevice(&device), "Asking for the device");
    return device;
  }

  int device = currentDevice();
  MediumView<Real> view; ///< on the device
  Buffer<Real> samples;
  std::unique_ptr<Buffer<std::uint32_t>> solid;

  struct Tree
  {
    explicit Tree(const MediumArrays<Real>& medium)
      : leaves(medium.leaves.first, medium.leaves.count, "Copying the medium's leaves")
      , roots(medium.roots.first, medium.roots.count, "Copying the medium's tree")
      , children(medium.children.first, medium.children.count, "Copying the medium's tree")
      , firstGradient(medium.firstGradient)
    {
      if (medium.gasDistances.count > 0)
      {
        gasDistances = std::make_unique<Buffer<std::int16_t>>(
          medium.gasDistances.first, medium.gasDistances.count, "Copying the walls");
      }
      if (medium.gradients.count > 0)
      {
        gradients = std::make_unique<Buffer<float>>(
          medium.gradients.first, medium.gradients.count, "Copying the gradients of the fields");
        gradientBricks = std::make_unique<Buffer<std::int32_t>>(medium.gradientBricks.first,
          medium.gradientBricks.count, "Copying the gradients of the fields");
      }
    }
    Buffer<Leaf<Real>> leaves;
    Buffer<std::int32_t> roots, children;
    std::unique_ptr<Buffer<std::int16_t>> gasDistances;
    std::unique_ptr<Buffer<float>> gradients;
    std::unique_ptr<Buffer<std::int32_t>> gradientBricks;
    std::ptrdiff_t firstGradient; ///< where the view begins
  };
  std::unique_ptr<Tree> tree;

  struct Map
  {
    Map(const HomogeneityView& view, double toleranceOfView)
      : tolerance(toleranceOfView)
      , levels(view.levels,
          static_cast<std::size_t>(view.bricks[0] * view.bricks[1] * view.bricks[2]),
          "Copying the homogeneity map")
    {
    }
    double tolerance;
    Buffer<std::uint8_t> levels;
  };
  std::unique_ptr<Map> map;

  struct Gradients
  {
    Gradients(const FieldGradientsView& view, std::uint64_t versionOfValues)
      : version(versionOfValues)
      , values(view.values,
          static_cast<std::size_t>(view.count * view.planeStride * (view.lastCell[2] + 2)),
          "Copying the gradients of the fields")
    {
    }
    std::uint64_t version;
    Buffer<float> values;
  };
  std::unique_ptr<Gradients> gradients;

  /// One launch ends while the next is under way.
  struct Lane
  {
    Stream stream;
    Event begin, end;                ///< of its launch
    Buffer<MarchTotals> totals{ 1 }; ///< of its launches
    std::int64_t crossed = 0;        ///< likewise, of those that have ended
  };
  std::array<Lane, 2> lanes;

  /// The pace of the last pass, and what it depends on.
  std::optional<LaunchPace> pace;
  std::tuple<PathModel, Integrator, Interpolation, std::int32_t, int> paced{};

  void findPace(const RayTask<Real>& task, int fields)
  {
    const KernelChoice& kernel = task.kernel;
    const auto now =
      std::make_tuple(kernel.path, kernel.integrator, kernel.interpolation, task.stepLimit, fields);
    if (!pace || now != paced)
    {
      // Steps may be shorter, and a step reads at several places; many GPUs are slow in double precision.
      const bool isAdaptive = kernel.integrator == Integrator::Adaptive;
      const double steps =
        static_cast<double>(task.stepLimit) / (trappedFactor * (isAdaptive ? adaptiveFactor : 1));
      const double places = isAdaptive || kernel.integrator == Integrator::Rk4 ? 4 : 1;
      const double precision = sizeof(Real) == sizeof(float) ? 1 : 10;
      pace.emplace(steps * places * precision);
      paced = now;
    }
  }

  /// The task with what it points to on the device. Sends what is new.
  RayTask<Real> upload(const RayTask<Real>& task, const TaskVersions& versions)
  {
    RayTask<Real> onDevice = task;
    onDevice.medium = view;
    if (task.map.levels != nullptr)
    {
      if (!map || map->tolerance != versions.homogeneityTolerance)
      {
        map.reset();
        map = std::make_unique<Map>(task.map, versions.homogeneityTolerance);
      }
      onDevice.map.levels = map->levels.data();
    }
    if (tree && task.gradients.count > 0)
    {
      onDevice.gradients.values = tree->gradients->data() + tree->firstGradient;
      onDevice.gradients.bricks = tree->gradientBricks->data();
    }
    else if (task.gradients.count > 0)
    {
      if (!gradients || gradients->version != versions.gradients)
      {
        gradients.reset(); // first: both at once might not fit
        gradients = std::make_unique<Gradients>(task.gradients, versions.gradients);
      }
      onDevice.gradients.values = gradients->values.data();
    }
    return onDevice;
  }
};

template <class Real>
CudaTracer<Real>::CudaTracer(const Medium<Real>& medium)
  : CudaTracer(MediumArrays<Real>::of(medium))
{
}

template <class Real>
CudaTracer<Real>::CudaTracer(const MediumArrays<Real>& medium)
  : memory_(std::make_unique<DeviceMemory>(medium))
{
}

template <class Real>
CudaTracer<Real>::~CudaTracer() = default;

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
  const RayTask<Real> onDevice = memory_->upload(task, versions);
  const auto rays = static_cast<std::size_t>(pass.columns * pass.rows);
  const CudaPass* there = traced.onDevice.get();
  const int fields = exits == Exits::OnHost ? task.gradients.count : 0;
  const std::size_t sums = rays * static_cast<std::size_t>(fields);
  const std::unique_ptr<Buffer<float>> gathered =
    fields > 0 ? std::make_unique<Buffer<float>>(sums) : nullptr;
  for (auto& lane : memory_->lanes)
  {
    checkCuda(cudaMemset(lane.totals.data(), 0, sizeof(MarchTotals)), "Clearing the totals");
    lane.crossed = 0;
  }
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
    constexpr std::int64_t maxBlocks = 65535; // along a grid's second axis
    std::int64_t wanted =
      std::clamp<std::int64_t>(memory_->pace->rays() / pass.columns / blockRows, 1, maxBlocks);
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
    const dim3 blocks(static_cast<unsigned>((pass.columns + blockColumns - 1) / blockColumns),
      static_cast<unsigned>((rows + blockRows - 1) / blockRows));
    lane.begin.record(lane.stream);
    visitScheme(task.kernel.interpolation,
      [&](auto scheme)
      {
        launchMarch<decltype(scheme)>(onDevice, fields > 0,
          { pass, firstRow, there->exits(), gathered ? gathered->data() : nullptr,
            lane.totals.data() },
          blocks, lane.stream.get());
      });
    checkCuda(cudaGetLastError(), "Starting the ray kernel");
    lane.end.record(lane.stream);
    return { { &lane, firstRow, rows } };
  };
  const auto totalsOf = [](const typename DeviceMemory::Lane& lane)
  {
    MarchTotals totals{};
    copy(&totals, lane.totals.data(), 1, lane.stream);
    lane.stream.wait("Tracing rays");
    return totals;
  };
  /// Waits for the launch.
  const auto fetch = [&](const Launch& launched)
  {
    auto& lane = *launched.lane;
    const auto count = static_cast<std::size_t>(launched.rows * pass.columns);
    if (exits == Exits::OnHost)
    {
      const auto first = static_cast<std::size_t>(launched.firstRow * pass.columns);
      copy(traced.exits.data() + first, there->exits() + first, count, lane.stream);
      if (fields > 0)
      {
        const auto perRay = static_cast<std::size_t>(fields);
        copy(traced.gathered.data() + first * perRay, gathered->data() + first * perRay,
          count * perRay, lane.stream);
      }
    }
    const auto crossed = static_cast<std::int64_t>(totalsOf(lane).crossed);
    memory_->pace->add(static_cast<std::int64_t>(count), crossed - lane.crossed,
      Event::secondsBetween(lane.begin, lane.end));
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
    const MarchTotals totals = totalsOf(lane);
    double worstDrift = 0;
    std::memcpy(&worstDrift, &totals.worstDrift, sizeof(worstDrift));
    traced.crossed += static_cast<std::int64_t>(totals.crossed);
    traced.worstDrift = std::max(traced.worstDrift, worstDrift);
  }
  return true;
}

template class CudaTracer<float>;
template class CudaTracer<double>;

} // namespace schlieren
