// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/PixelArray.h"

namespace schlieren
{

/// The largest SmoothingRadius, pixels: a pixel then takes seven thousand others into account.
constexpr double largestSmoothingRadius = 32;

/// Each value of an image, any number of them for a pixel, as the mean of those around, within the image, weighted by
/// exp(-d^2 / (2 s^2)) at a distance of d pixels, s = radius / 2, up to d = 3 s. Below two thirds of a pixel that reaches
/// no neighbour.
PixelArray<float> smoothed(
  PixelArray<float> image, int width, int height, double radius, int threads);

} // namespace schlieren
