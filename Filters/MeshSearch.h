// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MeshSampler.h"
#include "WorkProgress.h"

#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <cstdint>
#include <vector>

class vtkDoubleArray;

namespace filters
{

/// Where a grid's points lie in a mesh, kept from one conversion to the next: time steps and fields change
/// values, hardly ever the mesh. A mesh is known by a hash of all that the search depends on, since
/// readers make new objects for each step.
struct MeshSearch
{
  /// Larger grids are searched again each time: 16 bytes for each point, 1 GB.
  static constexpr vtkIdType maxPointsKept = vtkIdType{ 1 } << 26;

  std::uint64_t key = 0;                         // of the last mesh; 0: none
  bool isSeries = false;                         // whether the one before was the same
  bool isNeededAgain = false;                    // keep the places the first time
  std::vector<Places> places;                    // of each piece; empty: not kept
  vtkSmartPointer<vtkUnsignedCharArray> outside; // as outsideOf() makes it; null: not known
  long long count = 0;                           // of searches so far

  void release();
};

/// The grid's values and which are valid, for the scalars of `leaves` (see MeshSampler); searches only if
/// it has to. Returns false, with nothing useful in the arrays, if it was stopped.
bool sampleMeshes(const std::vector<vtkDataSet*>& leaves, vtkImageData* grid, int flatAxis,
  MeshSearch& search, const Progress& progress, vtkDoubleArray* values,
  vtkUnsignedCharArray* valid);

/// The points that lie neither in visible nor in hidden cells of `leaves`, after sampleMeshes() with the same
/// arguments. Null if it was stopped.
vtkSmartPointer<vtkUnsignedCharArray> outsideOf(const std::vector<vtkDataSet*>& leaves,
  vtkImageData* grid, int flatAxis, MeshSearch& search, const Progress& progress,
  vtkUnsignedCharArray* valid);

} // namespace filters
