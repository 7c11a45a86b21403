// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Included by CudaTracer.cu.
#pragma once

#include "Device/CudaBuffer.h"
#include "Rays/Cuda/CudaMarch.h"
#include "Rays/Cuda/CudaTracer.h"
#include "Rays/Cuda/LaunchPace.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <tuple>

namespace schlieren
{

template <class T>
void copyRays(T* toHost, const T* fromDevice, std::size_t count, const CudaStream& stream)
{
  checkCuda(
    cudaMemcpyAsync(toHost, fromDevice, count * sizeof(T), cudaMemcpyDeviceToHost, stream.get()),
    "Fetching rays");
}

/// What a tracer has on the device.
template <class Real>
struct CudaTracer<Real>::DeviceMemory
{
  /// Sends the medium.
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
      solid = std::make_unique<CudaBuffer<std::uint32_t>>(
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
  CudaBuffer<Real> samples;
  std::unique_ptr<CudaBuffer<std::uint32_t>> solid;

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
        gasDistances = std::make_unique<CudaBuffer<std::int16_t>>(
          medium.gasDistances.first, medium.gasDistances.count, "Copying the walls");
      }
      if (medium.gradients.count > 0)
      {
        gradients = std::make_unique<CudaBuffer<float>>(
          medium.gradients.first, medium.gradients.count, "Copying the gradients of the fields");
        gradientBricks = std::make_unique<CudaBuffer<std::int32_t>>(medium.gradientBricks.first,
          medium.gradientBricks.count, "Copying the gradients of the fields");
      }
    }
    CudaBuffer<Leaf<Real>> leaves;
    CudaBuffer<std::int32_t> roots, children;
    std::unique_ptr<CudaBuffer<std::int16_t>> gasDistances;
    std::unique_ptr<CudaBuffer<float>> gradients;
    std::unique_ptr<CudaBuffer<std::int32_t>> gradientBricks;
    std::ptrdiff_t firstGradient; ///< where the view begins
  };
  std::unique_ptr<Tree> tree;

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
    CudaBuffer<float> values;
  };
  std::unique_ptr<Gradients> gradients;

  /// One launch ends while the next is under way.
  struct Lane
  {
    CudaStream stream;
    CudaEvent begin, end;                ///< of its launch
    CudaBuffer<MarchTotals> totals{ 1 }; ///< of its launches
    std::int64_t crossed = 0;            ///< likewise, of those that have ended

    /// Waits for its launches.
    MarchTotals fetchTotals() const
    {
      MarchTotals fetched{};
      copyRays(&fetched, totals.data(), 1, stream);
      stream.wait("Tracing rays");
      return fetched;
    }
  };
  std::array<Lane, 2> lanes;

  void clearTotals()
  {
    for (Lane& lane : lanes)
    {
      checkCuda(cudaMemset(lane.totals.data(), 0, sizeof(MarchTotals)), "Clearing the totals");
      lane.crossed = 0;
    }
  }

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
      const double places = isAdaptive ? 4 : 1;
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

} // namespace schlieren
