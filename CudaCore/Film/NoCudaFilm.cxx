// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Takes the place of CudaFilm.cu in builds without CUDA.
#include "Film/CudaFilm.h"

namespace schlieren
{

struct CudaFilm::DeviceMemory
{
};

CudaFilm::CudaFilm(const Films&, std::int64_t) { throw DeviceError(builtWithoutCuda); }

CudaFilm::~CudaFilm() = default;

void CudaFilm::expose(const CudaPass&, const Pass&, const Cutoffs&, const Projection&, std::int64_t)
{
}

RayCounts CudaFilm::develop(Films&) const { return {}; }

void CudaFilm::developCentres(Image&) const {}

} // namespace schlieren
