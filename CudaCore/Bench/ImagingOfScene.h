// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Optics/Techniques.h"
#include "Schlieren.h"
#include "Waves/FourierPlane.h"

#include <string>

namespace schlieren
{

/// How the light of one wavelength makes the image of a scene that has a plane in focus. `k`: of techniques that have one;
/// `wavelength`: metres; `pixelSize`: data units; `lengthScale`: metres in one.
Imaging imagingOf(
  const Scene& scene, double k, double wavelength, double pixelSize, double lengthScale);

/// For what rays would do instead of waves; empty where their widths say it. `width`: wavelength times k, metres.
std::string noteOnRays(Cutoff cutoff, double width);

} // namespace schlieren
