// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Waves/WaveField.h"

#include <complex>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// The light of the pixels that rays have been traced for: those of an image and those around it, row by row.
struct WavePixels
{
  /// All dark. `raysPerPixel`: along each axis.
  WavePixels(const LightAtExit& light, std::int64_t raysPerPixel);

  /// Adds `weight` times the mean of |undisturbed + field|^2 over the points of each pixel.
  void add(const ComplexField& field, const WaveGrid& grid, std::complex<double> undisturbed,
    double weight, int threads);

  /// The light of the pixels in the middle.
  std::vector<float> image(std::int64_t width, std::int64_t height) const;

  std::int64_t raysPerPixel;
  std::int64_t columns, rows;
  std::vector<double> light;
};

} // namespace schlieren
