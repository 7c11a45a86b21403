// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MeshArrays.h"

#include <functional>
#include <vector>

namespace refractivity
{

/**
 * The gradients of a dataset's values at its points, three numbers each; zero at points of no cell.
 *
 * Each is that of the quadratic polynomial that fits the values at the points of the same cells best, so
 * that of a quadratic field is exact. Where none fits well, as at a shock, gradients are made smaller until
 * they lead to no value that a point of these cells is not near to.
 */
std::vector<float> pointGradients(
  const MeshArrays& mesh, const std::function<bool(vtkIdType)>& isCellUsed);

} // namespace refractivity
