// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"

namespace schlieren
{

/// Light within what a film takes of one ray, 0 ... 1. Of NaN: 0.
SCHLIEREN_HD double limited(double light) { return light > 0 ? (light < 1 ? light : 1) : 0; }

/// Luminance of linear red, green and blue with sRGB's primaries (ITU-R BT.709-6, sec. 3).
SCHLIEREN_HD double luminanceOf(const double (&light)[3])
{
  return 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
}
SCHLIEREN_HD double luminanceOf(const double (&light)[1]) { return light[0]; }

/// Linear light of an sRGB value, both 0 ... 1 (IEC 61966-2-1).
double linearFromSrgb(double value);

} // namespace schlieren
