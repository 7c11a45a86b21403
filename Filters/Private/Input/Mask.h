// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/RefractivitySource.h"

#include "vtkSmartPointer.h"

/// Data whose arrays say where there is no gas.
namespace filters
{

/// An array, and which of its values say so.
struct Mask
{
  vtkDataArray* values; // with one component
  bool ofCells;
  double threshold;
  bool hidesAbove; // what is not less than the threshold, rather than what is less

  /// NaN is masked, too.
  bool hides(double value) const
  {
    return this->hidesAbove ? !(value < this->threshold) : !(value >= this->threshold);
  }
};

/// A shallow copy of a leaf's data in which what the mask says is hidden: cells; or points, if the leaf's values
/// belong to points. Where the values belong to cells and the mask to points, cells with any such point.
vtkSmartPointer<vtkDataSet> hideMasked(const Leaf& leaf, const Mask& mask);

} // namespace filters
