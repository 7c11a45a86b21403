// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rays/TracedRays.h"

namespace schlieren
{

/// The k that maps the 99th percentile of |eps| to full scale (k |eps| = 1/2), over the pixels of the
/// picture whose rays crossed the medium and reached the film. Deflections below `noiseFloor` do not
/// count as signal: they bound k from above. 1 where nothing bends at all.
double automaticK(const TracedRays& rays, int width, int height, double noiseFloor, int threads);

} // namespace schlieren
