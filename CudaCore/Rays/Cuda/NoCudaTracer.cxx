// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Replaces CudaTracer.cu in builds without CUDA.
#include "Rays/Cuda/CudaTracer.h"

namespace schlieren
{

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
  const RayTask<Real>&, const Passes&, Exits, TracedPass&, const Monitor&)
{
  return false;
}

template class CudaTracer<float>;
template class CudaTracer<double>;

} // namespace schlieren
