// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/CudaPass.h"

#include "Device/CudaBuffer.h"

namespace schlieren
{

CudaPass::CudaPass(std::size_t rays)
  : exits_(allocateOnCuda<RayExit, DeviceError>(rays))
  , size_(rays)
{
}

CudaPass::CudaPass(const std::vector<RayExit>& exits)
  : CudaPass(exits.size())
{
  checkCuda<DeviceError>(
    cudaMemcpy(exits_, exits.data(), size_ * sizeof(RayExit), cudaMemcpyHostToDevice),
    "Sending rays");
}

CudaPass::~CudaPass() { cudaFree(exits_); }

std::vector<RayExit> CudaPass::toHost() const
{
  std::vector<RayExit> exits(size_);
  checkCuda<DeviceError>(
    cudaMemcpy(exits.data(), exits_, size_ * sizeof(RayExit), cudaMemcpyDeviceToHost),
    "Fetching rays");
  return exits;
}

} // namespace schlieren
