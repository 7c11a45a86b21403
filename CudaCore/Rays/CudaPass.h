// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/DeviceError.h"
#include "Rays/DeflectionBins.h"
#include "Rays/RayExit.h"

#include <cstddef>
#include <vector>

namespace schlieren
{

/// Whether the device has memory to keep the rays of a pass of so many bytes, and for what then follows.
bool canKeepOnCuda(std::size_t bytes);

/// The rays of a pass, row by row, in the memory of the CUDA device. Throws DeviceError.
class CudaPass
{
public:
  /// Room for so many rays; not initialised.
  explicit CudaPass(std::size_t rays);
  explicit CudaPass(const RayExits& exits);
  /// Makes all rays undisturbed ones.
  void makeUndisturbed();
  CudaPass(const CudaPass&) = delete;
  CudaPass& operator=(const CudaPass&) = delete;
  ~CudaPass();

  RayExit* exits() const { return exits_; } ///< in the device's memory
  std::size_t size() const { return size_; }
  RayExits toHost() const;

  /// The largest component of deflection of the rays that start in an image of this size and reach the film; the rays
  /// are those of `pass`.
  double largestDeflection(const Pass& pass, int width, int height) const;
  /// Adds these rays to `counts`, which has `bins` times `bins`, by their deflection: see DeflectionHistogram.
  void countDeflections(const Pass& pass, int width, int height, const DeflectionBins& bins,
    std::vector<std::int64_t>& counts) const;

  /// The rays that start in an image and crossed the medium, by the LeadingBits of their squared deflection.
  struct Squares
  {
    std::vector<std::int64_t> counts;
    double largest;
  };
  Squares countSquares(const Pass& pass, int width, int height) const;
  /// The squared deflections of one bin, which holds `count`, in any order.
  std::vector<double> squaresIn(
    std::size_t bin, std::int64_t count, const Pass& pass, int width, int height) const;

private:
  RayExit* exits_ = nullptr;
  std::size_t size_;
};

} // namespace schlieren
