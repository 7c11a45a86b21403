// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Takes the place of CudaHomogeneityMap.cu in builds without CUDA.
#include "Medium/CudaHomogeneityMap.h"

namespace schlieren
{

template <class Real>
HomogeneityMap<Real> buildHomogeneityMapOnCuda(const Medium<Real>&, Interpolation, Real)
{
  throw DeviceError("this build has no CUDA support");
}

template HomogeneityMap<float> buildHomogeneityMapOnCuda(
  const Medium<float>&, Interpolation, float);
template HomogeneityMap<double> buildHomogeneityMapOnCuda(
  const Medium<double>&, Interpolation, double);

} // namespace schlieren
