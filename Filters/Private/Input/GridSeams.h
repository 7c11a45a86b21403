// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Vectors.h"

#include "vtkType.h"

#include <array>
#include <map>

class vtkDataSet;

namespace filters
{

/// The points on the sides of a curvilinear grid, by their numbers in the whole grid.
using OuterPoints = std::map<vtkIdType, Point>;

/// Adds those of a piece of a grid. `whole`: the extent of the grid's points.
void addOuterPoints(vtkDataSet* piece, const std::array<int, 6>& whole, OuterPoints& points);

/// Returns whether faces of cells on the sides of a grid coincide but for rounding, as at the seam
/// of an O-grid and the wake cut of a C-grid, or collapse along one of the axes `across`, as at a
/// pole.
bool hasSeam(const OuterPoints& points, const std::array<int, 6>& whole,
  const std::array<bool, 3>& across = {});

} // namespace filters
