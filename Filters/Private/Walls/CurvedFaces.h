// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Walls/MeshFaces.h"

#include <functional>
#include <vector>

namespace filters
{

/// Adds the faces that only one of these cells of a leaf has, divided into parts: those of curved 3-D cells. Faces are
/// one if their corners and middles are the same points, also where the points are there twice, as those of
/// discontinuous solutions are. `isWanted`: whether a cell's faces are added.
void addCurvedCells(vtkDataSet* data, std::uint32_t leaf, const std::vector<vtkIdType>& cells,
  State state, const std::function<bool(vtkIdType cell)>& isWanted, Faces& faces);

} // namespace filters
