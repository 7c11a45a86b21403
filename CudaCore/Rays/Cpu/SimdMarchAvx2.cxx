// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// For AVX2 and FMA.
#include "Rays/Cpu/SimdMarch.inl"

namespace schlieren
{

template MarchFunction<float, 8> simdMarch(const KernelChoice&);
template MarchFunction<double, 4> simdMarch(const KernelChoice&);

} // namespace schlieren
