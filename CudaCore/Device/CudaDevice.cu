// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/CudaDevice.h"

#include "Device/CudaBuffer.h"

namespace schlieren
{

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

} // namespace schlieren
