// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Included by each of the SimdMarch*.cxx, which differ in what they are compiled for.
#define SCHLIEREN_INLINE_ALL
#include "Medium/SimdInterpolation.h"
#include "Rays/SimdMarch.h"

namespace schlieren
{

template <class Kernel, class Pack>
void marchPack(
  const RayTask<NumberOf<Pack>>& task, RayBatch<NumberOf<Pack>, lanesOf<Pack>>& batch)
{
  march<Kernel, Pack>(task, batch);
}

template <class Number, int Lanes>
MarchFunction<Number, Lanes> simdMarch(const KernelChoice& choice)
{
  return visitKernel(choice, [](auto kernel) -> MarchFunction<Number, Lanes>
    { return &marchPack<decltype(kernel), SimdPack<Number, Lanes>>; });
}

} // namespace schlieren
