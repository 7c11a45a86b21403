// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// For any processor.
#include "Rays/Cpu/SimdMarch.inl"

namespace schlieren
{

template MarchFunction<float, 4> simdMarch(const KernelChoice&);

} // namespace schlieren
