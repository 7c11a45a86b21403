// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Replaces CudaPass.cu in builds without CUDA.
#include "Rays/CudaPass.h"

namespace schlieren
{

bool canKeepOnCuda(std::size_t) { return false; }

CudaPass::CudaPass(std::size_t rays)
  : size_(rays)
{
  throw DeviceError(builtWithoutCuda);
}

CudaPass::CudaPass(const RayExits& exits)
  : CudaPass(exits.size())
{
}

CudaPass::~CudaPass() = default;

void CudaPass::makeUndisturbed() {}

RayExits CudaPass::toHost() const { return {}; }

double CudaPass::largestDeflection(const Pass&, int, int) const { return 0; }

void CudaPass::countDeflections(
  const Pass&, int, int, const DeflectionBins&, std::vector<std::int64_t>&) const
{
}

CudaPass::Squares CudaPass::countSquares(const Pass&, int, int) const { return {}; }

std::vector<double> CudaPass::squaresIn(std::size_t, std::int64_t, const Pass&, int, int) const
{
  return {};
}

} // namespace schlieren
