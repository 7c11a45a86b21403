// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Leaf.h"
#include "Gas/RefractivityModels.h"

#include "vtkSmartPointer.h"

class vtkImageData;
class vtkUnsignedCharArray;

/// From arrays' values to refractivity and to the mask that says which of them are valid.
namespace filters
{

/// N as a new vtkFloatArray or vtkDoubleArray. Clears `valid` where N is not finite; N is `invalid`
/// where `valid` is 0. Adds to the tally what was valid before and had finite values.
template <class Array>
vtkSmartPointer<Array> convert(const Arrays& values, const Model& model,
  vtkUnsignedCharArray* valid, double invalid, Tally& tally);

/// Adds both arrays to `output`, whose points the values and the mask belong to. Without a mask all are
/// valid as yet. Of a plane the values may be those of one layer.
Tally setArrays(vtkImageData* output, const Arrays& values, const Model& model,
  vtkUnsignedCharArray* valid, Numbers numbers);

/// Adds TransparentPointMask to `output`: of the points in `outside` those that are masked, if there are any.
void setOutside(vtkUnsignedCharArray* outside, vtkImageData* output);

} // namespace filters
