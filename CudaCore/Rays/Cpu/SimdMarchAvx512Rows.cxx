// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// For AVX-512 (F, DQ, BW, VL) where gathers are slow.
#include "Rays/Cpu/SimdMarch.inl"

namespace schlieren
{

template MarchFunction<float, 16> simdMarchByRows(const KernelChoice&);
template MarchFunction<double, 8> simdMarchByRows(const KernelChoice&);

} // namespace schlieren
