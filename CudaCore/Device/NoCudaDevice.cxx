// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Replaces CudaDevice.cu in builds without CUDA.
#include "Device/CudaDevice.h"
#include "Device/DeviceError.h"

namespace schlieren
{

bool cudaAvailable(std::string* reason)
{
  if (reason != nullptr)
  {
    *reason = builtWithoutCuda;
  }
  return false;
}

} // namespace schlieren
