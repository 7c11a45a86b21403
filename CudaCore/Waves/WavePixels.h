// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Waves/WaveField.h"

#include <complex>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// A phase that grows evenly over columns and rows, in turns.
struct EvenPhase
{
  double perColumn = 0, perRow = 0;
  double atFirst = 0; ///< at the centre of column 0, row 0
};

/// The light of pixels that rays have been traced for, row by row: of an image, and some of those around it.
struct WavePixels
{
  /// All dark. `raysPerPixel`: along each axis; `leftOut`: pixels on each side of those that rays have been traced for.
  WavePixels(const LightAtExit& light, std::int64_t raysPerPixel, std::int64_t leftOut);

  /// Adds `weight` times the mean of |undisturbed + field|^2 over the points of each pixel.
  void add(const ComplexField& field, const WaveGrid& grid, std::complex<double> undisturbed,
    double weight, int threads);

  /// Adds `weight` times the mean of 1/2 + Re((undisturbed + field) exp(2 pi i turns)). `turns`: of points, from the first ray's
  /// first one.
  void addFringes(const ComplexField& field, const WaveGrid& grid, std::complex<double> undisturbed,
    const EvenPhase& turns, double weight, int threads);

  /// The rows of a field that the pixels take.
  RowRange rowsOf(const WaveGrid& grid) const;

  /// The light of the pixels in the middle.
  std::vector<float> image(std::int64_t width, std::int64_t height) const;

  std::int64_t raysPerPixel, leftOut;
  std::int64_t columns, rows;
  std::vector<double> light;

private:
  template <class LightOfPoint>
  void addMeans(const ComplexField& field, const WaveGrid& grid, double weight, int threads,
    const LightOfPoint& lightOf);
};

} // namespace schlieren
