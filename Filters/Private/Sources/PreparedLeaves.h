// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/RefractivitySource.h"
#include "Sources/SharedPoints.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <vector>

class vtkDataSet;

namespace filters
{

/// Treatment of cell values: averaged at points, with or without CellsAround.
enum class CellValues
{
  Averaged,
  Known // with CellsAround
};

/// Returns whether any cell has so many dimensions.
bool hasCells(vtkDataSet* data, int dimension);

/// Meshes of those leaves that have cells of as many dimensions as the source has, with nothing but N at their points (NaN
/// where invalid), and other cells hidden. Leaves that share points have become one. `shared`: which points these are; it
/// is found where it is null, and to be used for other values of the same leaves. `others`: which will come; where a leaf
/// lacks some of them, it shares no points with those that have them.
std::vector<vtkSmartPointer<vtkDataSet>> preparedLeaves(const Source& source, CellValues cellValues,
  Tally& tally, std::shared_ptr<const SharedPoints>& shared,
  const std::vector<const Source*>& others = {});

} // namespace filters
