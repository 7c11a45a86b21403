// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

class vtkScalarsToColors;

/// Returns the colours in which a map, unless it is null, draws the light of a legend's colours, whose bytes are up to
/// `white`. Null: they are not grey, and a map has none for them.
vtkSmartPointer<vtkUnsignedCharArray> paintedLight(
  vtkUnsignedCharArray* colors, double white, vtkScalarsToColors* map);
