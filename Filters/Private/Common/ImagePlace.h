// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkImageData.h"
#include "vtkMatrix3x3.h"

#include <algorithm>

namespace filters
{

/// Returns whether the points of two images with the same indices coincide, to the last bit.
inline bool haveSamePlace(vtkImageData* a, vtkImageData* b)
{
  const double* direction = a->GetDirectionMatrix()->GetData();
  return std::equal(a->GetOrigin(), a->GetOrigin() + 3, b->GetOrigin()) &&
    std::equal(a->GetSpacing(), a->GetSpacing() + 3, b->GetSpacing()) &&
    std::equal(direction, direction + 9, b->GetDirectionMatrix()->GetData());
}

} // namespace filters
