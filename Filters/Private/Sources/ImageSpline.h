// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrLevels.h"
#include "Schlieren.h"

#include <array>
#include <vector>

namespace filters
{

/// Values at an image's points and, between them, the quadratic spline through them (Unser, Aldroubi & Eden 1993). Values
/// that are not known are continued linearly from those around them.
class ImageSpline
{
public:
  using Range = schlieren::MediumSource::FieldRange;

  /// Of an image's field; `isKnown`: of each point; `first`: which point of a larger image the first one is, where it
  /// is a part of one.
  ImageSpline(const schlieren::Field& field, const std::vector<unsigned char>& isKnown,
    const Counts& points, const Counts& first, int threads);

  /// Samples lattice points. `places`: their index coordinates along each axis, in the image.
  void sample(const std::array<std::vector<double>, 3>& places, double* values) const;
  /// Of the values around points from `begin` to `last`: at least of those that have a part in what is between them, at
  /// most of the blocks of points of the larger image, in which these are.
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
