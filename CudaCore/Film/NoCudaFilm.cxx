// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Stands in for CudaFilm.cu in builds without CUDA.
#include "Film/CudaFilm.h"

#include "Optics/Cutoffs.h"

namespace schlieren
{

struct CudaFilm::DeviceMemory
{
};

CudaFilm::CudaFilm(const Film&) { throw DeviceError(builtWithoutCuda); }

CudaFilm::~CudaFilm() = default;

template <class CutoffKind>
void CudaFilm::shade(
  const CutoffKind&, const Projection&, const CudaPass&, const Pass&, std::int64_t)
{
}

RayCounts CudaFilm::develop(Film&, PixelMeans&) const { return {}; }

template void CudaFilm::shade(
  const KnifeEdge&, const Projection&, const CudaPass&, const Pass&, std::int64_t);
template void CudaFilm::shade(
  const Shadowgraph&, const Projection&, const CudaPass&, const Pass&, std::int64_t);

} // namespace schlieren
