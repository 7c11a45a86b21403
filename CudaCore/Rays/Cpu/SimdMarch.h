// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/March/RayTask.h"

namespace schlieren
{

/// Takes two batches of `Lanes` rays, side by side, through the medium.
template <class Number, int Lanes>
using MarchFunction = void (*)(
  const RayTask<Number>&, RayBatch<Number, Lanes>& one, RayBatch<Number, Lanes>& other);

/// The one for a kernel. Each width is compiled once, for the instructions that have it: 4 floats for any
/// processor; 8 floats and 4 doubles for AVX2 with FMA; 16 floats and 8 doubles for AVX-512.
template <class Number, int Lanes>
MarchFunction<Number, Lanes> simdMarch(const KernelChoice& choice);

} // namespace schlieren
