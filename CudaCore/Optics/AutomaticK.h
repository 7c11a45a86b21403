// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/TracedRays.h"

namespace schlieren
{

/// How far light is bent where it is bent strongly: the 99th percentile of |eps| over the pixels of the
/// picture whose rays crossed the medium and reached the film. At least `noiseFloor`: smaller deflections
/// do not count as signal. 0 where nothing bends at all.
double strongDeflection(
  const TracedRays& rays, int width, int height, double noiseFloor, int threads);

/// The k that maps a strong deflection to full scale, k |eps| = `fullScale`; 1 where there is none.
inline double automaticK(double deflection, double fullScale)
{
  return deflection > 0 ? fullScale / deflection : 1;
}

} // namespace schlieren
