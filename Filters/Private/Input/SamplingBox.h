// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

class vtkImageData;

namespace filters
{

/// Restricts the grid to a box in the data's coordinates. Along an axis whose second bound does not
/// exceed the first, the grid covers the domain.
class SamplingBox
{
public:
  /// Throws for bounds that are not finite.
  explicit SamplingBox(const double bounds[6]);

  bool isGiven() const
  {
    return this->isGivenAlong(0) || this->isGivenAlong(1) || this->isGivenAlong(2);
  }
  bool isGivenAlong(std::size_t axis) const
  {
    return this->bounds[2 * axis] < this->bounds[2 * axis + 1];
  }
  /// Returns whether the bounds restrict the domain or are not finite. Does not throw.
  static bool isWanted(const double bounds[6]);

  /// Intersects `bounds` with the box. Throws if nothing remains.
  std::array<double, 6> within(const double bounds[6]) const;

  /// Returns whether `bounds` and the box intersect.
  bool meets(const double bounds[6]) const;

  /// Reduces an image to the points that cover the box.
  void crop(vtkImageData* image) const;

  /// Returns the first and one past the last of `count` cells of an axis that cover the box.
  std::array<int, 2> cellsOf(std::size_t axis, double origin, double spacing, int count) const;

private:
  [[noreturn]] void isOutside(const double bounds[6]) const;

  std::array<double, 6> bounds;
};

} // namespace filters
