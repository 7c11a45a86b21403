// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/RefractivitySource.h"

#include "vtkSmartPointer.h"

/// Hides points or cells that an array marks as not gas.
namespace filters
{

/// An array, and which of its values mark what is not gas.
struct Mask
{
  vtkDataArray* values; // one component
  bool ofCells;
  bool hidesAbove; // hides values from the threshold on instead of those below it

  /// Hides NaN, too.
  bool hides(double value) const
  {
    constexpr double threshold = MediumSettings::maskThreshold;
    return this->hidesAbove ? !(value < threshold) : !(value >= threshold);
  }
};

/// Returns a shallow copy of a leaf's data in which masked cells are hidden, or masked points if
/// the leaf's values belong to points. If the mask belongs to points and the values to cells, hides
/// cells with any masked point.
vtkSmartPointer<vtkDataSet> hideMasked(const Leaf& leaf, const Mask& mask);

} // namespace filters
