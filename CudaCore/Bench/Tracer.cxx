// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/Tracer.h"

#include "Rays/Cpu/CpuTracer.h"

namespace schlieren
{

template <class Real>
bool Tracer<Real>::trace(const RayTask<Real>& task, const Passes& passes, TracedPass& traced,
  const Monitor& monitor, bool isWantedOnHost) const
{
  if (device_ == Device::Cuda)
  {
    using Exits = typename CudaTracer<Real>::Exits;
    const Exits exits = isWantedOnHost ? Exits::OnHost : Exits::OnDevice;
    CudaTracer<Real>& tracer = medium_->cudaTracer();
    return tracer.trace(task, passes, exits, traced, monitor);
  }
  return processes_
    ? medium_->processTracer().trace(task, passes, *processes_, traced, threads_, monitor)
    : traceOnCpu(task, passes, traced, threads_, monitor);
}

template class Tracer<float>;
template class Tracer<double>;

} // namespace schlieren
