// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

class vtkDataSet;
class vtkImageData;
class vtkMultiBlockDataSet;
class vtkUnsignedCharArray;

/// The places that have no gas and still let light pass, see vtkRefractiveIndex::OutsideBlocksLight.
namespace refractivity
{

/// Which points of a grid lie outside of all cells of this dimension. The leaves of `blocks` have cell ghost
/// arrays that hide some cells; `visible` tells (not 0) which points lie in the others.
vtkSmartPointer<vtkUnsignedCharArray> outsideOf(
  vtkMultiBlockDataSet* blocks, int dimension, vtkImageData* grid, vtkUnsignedCharArray* visible);

/// The points that an image says to be such in an array of its own; null where it has none.
vtkSmartPointer<vtkUnsignedCharArray> outsideFrom(vtkDataSet* image);

/// Adds those of them that are masked to `output`.
void setOutside(vtkUnsignedCharArray* outside, vtkImageData* output);

} // namespace refractivity
