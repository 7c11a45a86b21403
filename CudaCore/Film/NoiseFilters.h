// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Film/PixelArray.h"
#include "Types.h"

namespace schlieren
{

/// The largest NoiseFilterRadius, pixels: a pixel then takes 13 thousand others into account at most.
constexpr double largestFilterRadius = 32;

/// Whether a filter changes an image at all: below one pixel its radius reaches no neighbour.
bool filtersNoise(NoiseFilter filter, double radius);

/// Whether it wants to know the samples of each pixel.
bool countsSamples(NoiseFilter filter, double radius);

/// An image of any number of values for each pixel, each of which becomes a weighted mean of those around,
/// within the image. Weights by the distance d, in pixels:
/// - Gaussian: exp(-d^2 / (2 s^2)), s = radius / 2, up to d = 3 s.
/// - Mean: 1 up to d = radius.
/// - Cone: 1 - d / r (Jensen 1996, eq. 9 and below). The disc of radius r is the smallest around the pixel that
///   holds as many samples as one of `radius` does at one a pixel, pi radius^2; r is at most twice `radius`.
/// `samples`: for each pixel how many rays gave light; of the cone only.
PixelArray<float> filtered(PixelArray<float> image, int width, int height, NoiseFilter filter,
  double radius, const PixelArray<float>& samples, int threads);

} // namespace schlieren
