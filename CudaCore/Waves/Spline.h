// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Samples/Interpolation.h"
#include "Medium/Samples/Prefilter.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// The cubic B-spline through values at the points of a rectangle, row by row.
class Spline
{
public:
  Spline(const std::vector<double>& values, std::int64_t columns, std::int64_t rows)
    : coefficients_({ columns, rows, 1 })
  {
    for (std::int64_t row = 0; row < rows; ++row)
    {
      std::copy_n(values.begin() + row * columns, columns, &coefficients_.at(0, row, 0));
    }
    prefilterCubic(coefficients_, 1);
  }

  std::int64_t columns() const { return coefficients_.dimensions[0]; }
  std::int64_t rows() const { return coefficients_.dimensions[1]; }

  /// The four coefficients along an axis that weigh at `place`, from the first of them on, and their weights.
  struct Stencil
  {
    Stencil(double place, std::int64_t points)
    {
      const double inside = std::clamp(place, 0., static_cast<double>(points - 1));
      const auto cell = static_cast<std::int64_t>(inside);
      first = std::clamp<std::int64_t>(cell - 1, 0, std::max<std::int64_t>(points - 4, 0));
      CubicInterpolation::weights(inside - static_cast<double>(first + 1), value, slope);
    }
    std::int64_t first;
    double value[4], slope[4];
  };

  struct Sample
  {
    double value, alongColumns, alongRows; ///< derivatives by column and row
  };

  /// Needs at least four points along each axis. Beyond the outermost ones it is what it is there.
  Sample at(double column, double row) const
  {
    const Stencil x(column, columns()), y(row, rows());
    Sample sample{ 0, 0, 0 };
    for (int j = 0; j < 4; ++j)
    {
      const double* from = rowOf(y.first + j) + x.first;
      double value = 0, slope = 0;
      for (int i = 0; i < 4; ++i)
      {
        value += x.value[i] * from[i];
        slope += x.slope[i] * from[i];
      }
      sample.value += y.value[j] * value;
      sample.alongColumns += y.value[j] * slope;
      sample.alongRows += y.slope[j] * value;
    }
    return sample;
  }

  const double* rowOf(std::int64_t row) const
  {
    return coefficients_.samples.data() + coefficients_.index(0, row, 0);
  }

  /// The coefficients of the spline along one row of places, at `row`.
  void mixRows(double row, std::vector<double>& alongColumns) const
  {
    const Stencil y(row, rows());
    alongColumns.assign(static_cast<std::size_t>(columns()), 0);
    for (int j = 0; j < 4; ++j)
    {
      const double* from = rowOf(y.first + j);
      const double weight = y.value[j];
      for (std::size_t i = 0; i < alongColumns.size(); ++i)
      {
        alongColumns[i] += weight * from[i];
      }
    }
  }

private:
  PaddedVolume<double> coefficients_;
};

} // namespace schlieren
