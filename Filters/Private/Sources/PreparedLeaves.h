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

/// Makes meshes of the leaves that have cells of the source's dimension, with N alone at their
/// points (NaN if invalid), and other cells hidden. Leaves with common points are joined. `shared`:
/// the common points, found if null, for other values of the same leaves. `others`: later sources;
/// leaves that lack some of them are not joined with those that have them.
std::vector<vtkSmartPointer<vtkDataSet>> preparedLeaves(const Source& source, CellValues cellValues,
  Tally& tally, std::shared_ptr<const SharedPoints>& shared,
  const std::vector<const Source*>& others = {});

} // namespace filters
