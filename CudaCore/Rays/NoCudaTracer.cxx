// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Stands in for CudaTracer.cu in builds without CUDA.
#include "Rays/CudaTracer.h"

namespace schlieren
{

namespace
{
constexpr const char* builtWithoutCuda = "this build has no CUDA support";
}

bool cudaAvailable(std::string* reason)
{
  if (reason != nullptr)
  {
    *reason = builtWithoutCuda;
  }
  return false;
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
CudaTracer<Real>::~CudaTracer() = default;

template <class Real>
bool CudaTracer<Real>::trace(
  const RayTask<Real>&, const Pass&, std::uint64_t, TracedPass&, const Monitor&)
{
  throw DeviceError(builtWithoutCuda);
}

template class CudaTracer<float>;
template class CudaTracer<double>;

} // namespace schlieren
