// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/Cuda/CudaMarch.inl"

namespace schlieren
{

template void launchMarch<QuadraticInterpolation>(
  const RayTask<float>&, const MarchedBands&, const dim3&, cudaStream_t);
template void launchMarch<QuadraticInterpolation>(
  const RayTask<double>&, const MarchedBands&, const dim3&, cudaStream_t);

} // namespace schlieren
