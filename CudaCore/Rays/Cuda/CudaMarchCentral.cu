// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/Cuda/CudaMarch.inl"

namespace schlieren
{

template void launchMarch<CentralInterpolation>(
  const RayTask<float>&, bool, const MarchedRows&, const dim3&, cudaStream_t);

} // namespace schlieren
