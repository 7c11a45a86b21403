// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// For AVX-512 (F, DQ, BW, VL).
#include "Rays/Cpu/SimdMarch.inl"

namespace schlieren
{

template MarchFunction<float, 16> simdMarch(const KernelChoice&);
template MarchFunction<double, 8> simdMarch(const KernelChoice&);

} // namespace schlieren
