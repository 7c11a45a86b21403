// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

class vtkImageData;

namespace filters
{

/// The part of the domain that becomes a grid: a box in the data's coordinates. Along an axis whose second number is not
/// larger than the first, all of the domain.
class SamplingBox
{
public:
  /// Throws where numbers are not finite.
  explicit SamplingBox(const double bounds[6]);

  bool isGiven() const
  {
    return this->isGivenAlong(0) || this->isGivenAlong(1) || this->isGivenAlong(2);
  }
  bool isGivenAlong(std::size_t axis) const
  {
    return this->bounds[2 * axis] < this->bounds[2 * axis + 1];
  }
  /// Whether these bounds want anything but all of the data, be it a box or numbers that are not finite. Does not throw.
  static bool isWanted(const double bounds[6]);

  /// `bounds`, with what is given instead. Throws where nothing of them is in the box.
  std::array<double, 6> within(const double bounds[6]) const;

  /// Whether some of `bounds` is in the box.
  bool meets(const double bounds[6]) const;

  /// The points of an image that cover the box, as far as it reaches.
  void crop(vtkImageData* image) const;

  /// Of `count` cells of an axis, the first one and the one behind the last one that cover the box.
  std::array<int, 2> cellsOf(std::size_t axis, double origin, double spacing, int count) const;

private:
  [[noreturn]] void isOutside(const double bounds[6]) const;

  std::array<double, 6> bounds;
};

} // namespace filters
