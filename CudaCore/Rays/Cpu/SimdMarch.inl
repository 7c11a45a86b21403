// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Included by each of the SimdMarch*.cxx, which differ in what they are compiled for.
#if defined(__AVX__) || \
  !defined(__SANITIZE_ADDRESS__) // with checks in it, it would take minutes to compile
#define SCHLIEREN_INLINE_ALL
#endif
#include "Medium/Samples/SimdInterpolation.h"
#include "Rays/Cpu/MarchOfPacks.h"
#include "Rays/Cpu/SimdMarch.h"
#include "Rays/March/Kernels.h"

namespace schlieren
{

template <class Kernel, class Pack>
void marchPacks(const RayTask<NumberOf<Pack>>& task, RayBatch<NumberOf<Pack>, lanesOf<Pack>>& one,
  RayBatch<NumberOf<Pack>, lanesOf<Pack>>& other)
{
  if constexpr (Kernel::Integrator::samplesBeyond)
  {
    march<Kernel, Pack>(task, one); // steps that are long enough to keep the processor busy
    march<Kernel, Pack>(task, other);
  }
  else
  {
    March<Kernel, Pack> a(task, one);
    March<Kernel, Pack> b(task, other);
    marchTwo(a, b);
  }
}

template <class Number, int Lanes>
MarchFunction<Number, Lanes> simdMarch(const KernelChoice& choice)
{
  return visitKernel(choice,
    [](auto kernel) -> MarchFunction<Number, Lanes>
    { return &marchPacks<decltype(kernel), SimdPack<Number, Lanes>>; });
}

} // namespace schlieren
