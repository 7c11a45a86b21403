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

/// What becomes of values of cells: means around each point, and no more, or also what these are means of.
enum class CellValues
{
  Averaged,
  Known // see CellsAround
};

/// Whether any cell has so many dimensions.
bool hasCells(vtkDataSet* data, int dimension);

/// Meshes of those leaves that have cells of as many dimensions as the source has, with nothing but N at their points (NaN
/// where invalid), and other cells hidden. Leaves that share points have become one. `shared`: which points these are; it
/// is found where it is null, and to be used for other values of the same leaves. `others`: which will come; where a leaf
/// lacks some of them, it shares no points with those that have them.
std::vector<vtkSmartPointer<vtkDataSet>> preparedLeaves(const Source& source, CellValues cellValues,
  Tally& tally, std::shared_ptr<const SharedPoints>& shared,
  const std::vector<const Source*>& others = {});

} // namespace filters
