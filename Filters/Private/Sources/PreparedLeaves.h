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

/// Meshes with N or a field at their points.
using MeshLeaves = std::vector<vtkSmartPointer<vtkDataSet>>;
std::vector<vtkDataSet*> pointersTo(const MeshLeaves& leaves);

/// The same meshes with N and with each field; NaN: no value.
struct PreparedLeaves
{
  MeshLeaves refractivity;
  std::vector<MeshLeaves> fields;
};

/// Returns whether any cell has so many dimensions.
bool hasCells(vtkDataSet* data, int dimension);

/// Makes meshes of the leaves that have cells of the flow's dimension, with N alone at their points
/// (NaN if invalid) and other cells hidden; and the same of each field. Values of cells are averaged
/// at points, which get CellsAround, too. Joins leaves with common points that have the same fields.
PreparedLeaves preparedLeaves(const Flow& flow, const std::vector<Flow>& fields, Tally& tally);

} // namespace filters
