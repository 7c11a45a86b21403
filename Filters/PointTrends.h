// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MeshArrays.h"

#include <functional>
#include <vector>

namespace refractivity
{

/**
 * How a dataset's values go on around its points; nothing is known of points of no cell.
 *
 * Gradients are those of the quadratic polynomial that fits the values at the points of the same cells best
 * (where these are few, those around them, too), so those of a quadratic field are exact. Where it does not
 * fit well, as at a shock, they are made smaller.
 */
std::vector<PointTrend> pointTrends(
  const MeshArrays& mesh, const std::function<bool(vtkIdType)>& isCellUsed);

} // namespace refractivity
