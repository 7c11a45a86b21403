// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two images in one.
#pragma once

#include "Photograph/Plane.h"

#include "vtkSmartPointer.h"

class vtkUnsignedCharArray;

namespace filters
{

/// Those of vtkCompareWithPhotograph.
enum class View
{
  Photograph = 0,
  Simulated = 1,
  Over = 2,
  Swipe = 3,
  Chequerboard = 4,
  RedCyan = 5,
  Difference = 6
};

/// Returns red, green and blue of each point. `swipe`: the fraction of the width from the left that shows the photograph. Beyond the
/// photograph is the simulated image; of Photograph and Difference, grey.
vtkSmartPointer<vtkUnsignedCharArray> comparisonOf(
  const Plane& photograph, const Plane& simulated, View view, double swipe);

} // namespace filters
