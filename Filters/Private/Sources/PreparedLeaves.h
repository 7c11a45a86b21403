// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellTree.h"
#include "Input/Flow.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataSet;

namespace filters
{

/// Meshes with N at their points; NaN: no value.
using MeshLeaves = std::vector<vtkSmartPointer<vtkDataSet>>;
std::vector<vtkDataSet*> pointersTo(const MeshLeaves& leaves);

/// Returns whether any cell has so many dimensions.
bool hasCells(vtkDataSet* data, int dimension);

/// Makes meshes of the leaves that have cells of the flow's dimension, with N alone at their points
/// (NaN if invalid) and other cells hidden. Values of cells are averaged at points, which get
/// CellsAround, too. Joins leaves with common points.
MeshLeaves preparedLeaves(const Flow& flow, Tally& tally);

} // namespace filters
