// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Takes the place of CudaPass.cu and CudaTracer.cu in builds without CUDA.
#include "Rays/Cuda/CudaTracer.h"
#include "Rays/CudaPass.h"

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

int cudaCapability() { return 0; }

bool canKeepOnCuda(std::size_t) { return false; }

CudaPass::CudaPass(std::size_t rays)
  : size_(rays)
{
  throw DeviceError(builtWithoutCuda);
}

CudaPass::CudaPass(const RayExits& exits)
  : CudaPass(exits.size())
{
}

CudaPass::~CudaPass() = default;

RayExits CudaPass::toHost() const { return {}; }

void CudaPass::put(std::size_t, const char*, std::size_t) const {}

double CudaPass::largestDeflection(const Pass&, int, int) const { return 0; }

void CudaPass::countDeflections(
  const Pass&, int, int, const DeflectionBins&, std::vector<std::int64_t>&) const
{
}

CudaPass::Squares CudaPass::countSquares(const Pass&, int, int) const { return {}; }

std::vector<double> CudaPass::squaresIn(std::size_t, std::int64_t, const Pass&, int, int) const
{
  return {};
}

template <class Real>
struct CudaTracer<Real>::DeviceMemory
{
};

template <class Real>
CudaTracer<Real>::CudaTracer(const Medium<Real>&)
{
  throw DeviceError(builtWithoutCuda);
}

template <class Real>
CudaTracer<Real>::CudaTracer(const MediumArrays<Real>&)
{
  throw DeviceError(builtWithoutCuda);
}

template <class Real>
CudaTracer<Real>::~CudaTracer() = default;

template <class Real>
void CudaTracer<Real>::begin(const RayTask<Real>&, const Pass&, Exits, TracedPass&) const
{
}

template <class Real>
bool CudaTracer<Real>::traceBands(const RayTask<Real>&, const Pass&, const TaskVersions&, Exits,
  const Tiles&, TracedPass&, const Monitor&)
{
  return false;
}

template <class Real>
bool CudaTracer<Real>::trace(
  const RayTask<Real>&, const Pass&, const TaskVersions&, Exits, TracedPass&, const Monitor&)
{
  return false;
}

template class CudaTracer<float>;
template class CudaTracer<double>;

} // namespace schlieren
