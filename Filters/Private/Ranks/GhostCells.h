// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <array>
#include <cstddef>
#include <vector>

class vtkDataSet;

namespace filters
{

/// The extent of points of an image or grid, inclusive, as VTK's.
using PointExtent = std::array<int, 6>;
constexpr PointExtent noPoints{ 0, -1, 0, -1, 0, -1 };

/// Returns the extent of the n-th of some pieces of a grid without those of pieces before it,
/// because readers may give grids with copies of others' cells. Ranks whose extents contain each
/// other number their points separately.
PointExtent withoutOverlap(const std::vector<PointExtent>& extents, std::size_t n);

/// Returns whether VTK makes ghost cells of datasets of a type.
bool canHaveGhostCells(int type);

/// Returns a rank's piece of a dataset, surrounded by layers of copies of other ranks' cells
/// (DUPLICATECELL). `own`: null if it has none; then, so is the result. `extent`: of grids, that is
/// used. All ranks call it.
vtkSmartPointer<vtkDataSet> withGhostCells(
  vtkDataSet* own, int type, const PointExtent& extent, int layers);

} // namespace filters
