// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Device/DeviceError.h"
#include "Medium/HomogeneityMap.h"

namespace schlieren
{

/// What buildHomogeneityMap does, on the first CUDA device. Throws DeviceError.
template <class Real>
HomogeneityMap<Real> buildHomogeneityMapOnCuda(
  const Medium<Real>& medium, Interpolation interpolation, Real tolerance);

} // namespace schlieren
