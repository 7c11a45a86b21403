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

template <class Real>
struct CudaTracer<Real>::DeviceMemory
{
  /// Sends the medium.
  explicit DeviceMemory(const Medium<Real>& medium)
    : view(medium.view())
    , samples(medium.tree ? bufferOf(medium.tree->samples()) : bufferOf(medium.volume.samples))
  {
    const Real* onHost = medium.tree ? medium.tree->samples().data() : medium.volume.samples.data();
    view.samples = samples.data() + (view.samples - onHost);
    if (medium.tree)
    {
      tree = std::make_unique<Tree>(*medium.tree);
      const std::int64_t ghost = view.samples - samples.data();
      view.leaves = tree->leaves.data();
      view.finder.roots = tree->roots.data();
      view.finder.children = tree->children.data();
      view.gasDistances =
        view.gasDistances != nullptr ? tree->gasDistances->data() + ghost : nullptr;
    }
    else if (!medium.solid.empty())
    {
      solid = std::make_unique<CudaBuffer<std::uint32_t>>(
        medium.solid.data(), medium.solid.size(), "Copying the solids");
      view.solid = solid->data();
    }
  }

  template <class Values>
  static auto bufferOf(const Values& values)
  {
    return CudaBuffer<typename Values::value_type>(
      values.data(), values.size(), "Copying the medium");
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
    explicit Tree(const MediumTree<Real>& of)
      : leaves(bufferOf(of.leaves()))
      , roots(bufferOf(of.roots()))
      , children(bufferOf(of.children()))
    {
      if (!of.gasDistances().empty())
      {
        gasDistances = std::make_unique<CudaBuffer<std::int16_t>>(
          of.gasDistances().data(), of.gasDistances().size(), "Copying the walls");
      }
    }
    CudaBuffer<Leaf<Real>> leaves;
    CudaBuffer<std::int32_t> roots, children;
    std::unique_ptr<CudaBuffer<std::int16_t>> gasDistances;
  };
  std::unique_ptr<Tree> tree;

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
  std::tuple<PathModel, Integrator, Interpolation, std::int32_t> paced{};

  void findPace(const RayTask<Real>& task)
  {
    const KernelChoice& kernel = task.kernel;
    const auto now =
      std::make_tuple(kernel.path, kernel.integrator, kernel.interpolation, task.stepLimit);
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
};

} // namespace schlieren
