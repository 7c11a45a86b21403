// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrLevels.h"
#include "Schlieren.h"

#include <array>
#include <vector>

namespace filters
{

/// A quadratic spline through an image's values (Unser, Aldroubi & Eden 1993). Extrapolates unknown
/// values linearly from those around them.
class ImageSpline
{
public:
  struct Range
  {
    double lowest, highest; // lowest > highest: there are no values
  };

  /// `isKnown`: of each point. `first`: index in the whole image of the field's first point.
  ImageSpline(const schlieren::Field& field, const std::vector<unsigned char>& isKnown,
    const Counts& points, const Counts& first, int threads);

  /// Samples lattice points. `places`: their index coordinates along each axis, in the image.
  void sample(const std::array<std::vector<double>, 3>& places, double* values) const;
  /// Returns a range of values that includes those that affect the points from `begin` to `last`,
  /// and at most their blocks in the whole image.
  Range rangeIn(const Counts& begin, const Counts& last) const;

private:
  Counts blockOf(const Counts& point) const;

  double Offset; // near all values, so that single precision suffices for differences
  schlieren::PaddedVolume<float> Coefficients;
  // Blocks of values, aligned in the whole image.
  Counts First, Blocks;
  std::vector<Range> Ranges;
};

/// Returns the value of a field at a point.
inline double valueAt(const schlieren::Field& field, std::size_t point)
{
  return field.offset +
    (field.singles ? static_cast<double>(field.singles[point]) : field.doubles[point]);
}

} // namespace filters
