// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The sensor behind a camera's lens: what it records of an image's light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

struct Sensor
{
  double fullWell = 0;   ///< electrons that a pixel can hold, positive
  double exposure = 0.8; ///< of the full well, that light 1 fills
  double readNoise = 10; ///< standard deviation, electrons
  double gamma = 1;      ///< values are the light to the power of 1 / gamma
  int bitDepth = 8;      ///< of the values, 1 ... 16
  std::uint32_t seed = 1;
};

/// The values of pixels with light `light`, row by row. Shot noise has the variance of the electrons, and is normal, which
/// is right up to the skewness of a few of them. Each pixel's noise follows from the seed, the pixel's number and the
/// number of the image: it is independent of the number of threads (0: all cores).
std::vector<std::uint16_t> record(
  const float* light, std::size_t pixels, const Sensor& sensor, std::uint32_t image, int threads);

} // namespace schlieren
