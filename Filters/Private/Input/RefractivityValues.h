// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Leaf.h"
#include "Gas/RefractivityModels.h"

#include "vtkSmartPointer.h"

class vtkImageData;
class vtkUnsignedCharArray;

/// Converts the values of arrays to refractivity and a mask of valid points.
namespace filters
{

/// Returns N as a new vtkFloatArray or vtkDoubleArray. Clears `valid` where N is not finite, and
/// sets N to `invalid` where `valid` is 0. Counts values that were valid and finite in the tally.
template <class Array>
vtkSmartPointer<Array> convert(const Arrays& values, const Model& model,
  vtkUnsignedCharArray* valid, double invalid, Tally& tally);

/// Adds Refractivity and its mask to `output`. Null mask: all points are valid. Values of a plane
/// may be those of one layer.
Tally setArrays(vtkImageData* output, const Arrays& values, const Model& model,
  vtkUnsignedCharArray* valid, Numbers numbers);

/// Adds TransparentPointMask: the masked points among `outside`, if there are any.
void setOutside(vtkUnsignedCharArray* outside, vtkImageData* output);

} // namespace filters
