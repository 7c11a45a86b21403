// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/CudaPass.h"
#include "Rays/TracedRays.h"

namespace schlieren
{

/// Errors of the deflections that are known before any ray is traced.
struct DeflectionErrors
{
  double rounding = 0; ///< of samples, see noiseFloor
  double medium =
    0; ///< of 99 % of the rays, by the size of voxels: MediumStatistics::deflectionError
};

/// How far light is bent where it is bent strongly: the 99th percentile of |eps| over the pixels of the
/// image whose rays crossed the medium and reached the film. 0 where nothing bends at all. At least
/// - `errors.rounding`: smaller deflections do not count as signal;
/// - 50 times `errors.medium`, so that the medium's error is 2 % of full scale, but for that no more than a tenth of the
///   largest |eps|. Voxels are as fine as the largest deflection needs. Where the gas is undisturbed in nearly all of an
///   image, as in a whole far field, the percentile is a hundredth of that or less, and the edges of leaves, whose
///   errors are within the tolerance, would be seen. An image that flow fills has its percentile above a tenth, and keeps
///   it.
double strongDeflection(
  const TracedRays& rays, int width, int height, const DeflectionErrors& errors, int threads);
/// The same of rays on the device, which stay there. Throws DeviceError.
double strongDeflection(
  const CudaPass& rays, const Pass& pass, int width, int height, const DeflectionErrors& errors);

/// The k that maps a strong deflection to full scale, k |eps| = `fullScale`; 1 where there is none.
inline double automaticK(double deflection, double fullScale)
{
  return deflection > 0 ? fullScale / deflection : 1;
}

} // namespace schlieren
