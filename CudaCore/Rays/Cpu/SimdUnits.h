// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/Cpu/CpuTracer.h"

namespace schlieren
{

/// Whether there is a unit (SimdMarch*.cxx) for these instructions: SCHLIEREN_SIMD of the build decides.
constexpr bool isCompiledFor(Simd simd)
{
  switch (simd)
  {
    case Simd::Avx2:
#ifdef SCHLIEREN_SIMD_AVX2
      return true;
#else
      return false;
#endif
    case Simd::Avx512:
#ifdef SCHLIEREN_SIMD_AVX512
      return true;
#else
      return false;
#endif
    case Simd::None:
    case Simd::Four:
      break;
  }
  return true;
}

} // namespace schlieren
