// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/DeviceError.h"
#include "Rays/RayExit.h"

#include <cstddef>
#include <vector>

namespace schlieren
{

/// The rays of a pass, row by row, in the memory of the first CUDA device. Throws DeviceError.
class CudaPass
{
public:
  /// Room for so many rays; not initialised.
  explicit CudaPass(std::size_t rays);
  explicit CudaPass(const std::vector<RayExit>& exits);
  CudaPass(const CudaPass&) = delete;
  CudaPass& operator=(const CudaPass&) = delete;
  ~CudaPass();

  RayExit* exits() const { return exits_; } ///< in the device's memory
  std::size_t size() const { return size_; }
  std::vector<RayExit> toHost() const;

private:
  RayExit* exits_ = nullptr;
  std::size_t size_;
};

} // namespace schlieren
