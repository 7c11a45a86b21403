// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RefractivitySource.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataSet;
class vtkImageData;
class vtkUnsignedCharArray;

/// The places that have no gas and still let light pass, see vtkRefractiveIndex::OutsideBlocksLight.
namespace filters
{

/// Which points of a grid lie in the box of no leaf, where leaves fill their boxes. One without length
/// along an axis holds all of it.
vtkSmartPointer<vtkUnsignedCharArray> outsideOfBoxes(
  const std::vector<Leaf>& leaves, vtkImageData* grid);

/// The points that an image says to be such in an array of its own; null where it has none.
vtkSmartPointer<vtkUnsignedCharArray> outsideFrom(vtkDataSet* image);

/// Adds those of them that are masked to `output`.
void setOutside(vtkUnsignedCharArray* outside, vtkImageData* output);

} // namespace filters
