// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Medium.h"

namespace schlieren
{

/// Largest |sample|, and, box by box, largest difference of neighbouring samples along each axis, ghosts included
/// where they are used. With all schemes the value is a weighted mean of samples and a derivative one of
/// these differences, no weight negative, so that neither can be larger: the derivative of a B-spline is a
/// B-spline of one degree less of the differences; across the derivative's axis they weigh as for the value.
template <class Real>
void findBounds(Medium<Real>& medium, int threads);

} // namespace schlieren
