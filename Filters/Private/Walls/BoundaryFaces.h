// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Triangles.h"
#include "Common/WorkProgress.h"
#include "Walls/MeshFaces.h"

#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

class vtkDataSet;

namespace filters
{

/// Returns whether a visible cell of any leaf contains a point. Called from several threads.
using CellTest = std::function<bool(const Point& place)>;
/// Tests several points.
using CellsTest = std::function<std::vector<unsigned char>(const std::vector<Point>& places)>;

/// Extent of cells: the whole data, or a layer of data that do not depend on z, at whose sides
/// across z nothing ends.
enum class Extent
{
  Volume,
  Layer
};

/// Treatment of walls without thickness: faces at the same place of cells of one dataset that have
/// points of their own there, because SharedPoints has left them apart.
enum class Sheets
{
  Walls,
  Ignored
};

/// The boundary of the gas: faces of one visible cell only.
struct BoundaryFaces
{
  Triangles surface;                      ///< normals point into the gas
  std::vector<LeafPoint> origins;         ///< of its points
  std::vector<unsigned char> hidesBehind; ///< of each triangle: whether a hidden cell is behind it
  Extent extent = Extent::Volume;
};

/// Finds the boundary of all leaves together: datasets with a double scalar at each point, NaN
/// without gas. Cells are visible if they are 3-D and not hidden by a ghost array (hiddenCellBits).
/// Cells with a point without gas are hidden; cells with a point that is not finite are omitted.
///
/// Merges faces with the same points, also where points of several datasets coincide (see
/// coincidentPoints()). Omits faces without area, at a pole or an axis, and, with `areInCells`,
/// faces with cells on both sides whose points differ: overlapping blocks, hanging nodes, curved
/// sides of blocks with a gap of up to 0.05 of the cell's height or the face's smallest edge.
/// Includes sheets once from each side; others, whose cells share points, are not recognized.
///
/// `faces`: facesOf() the datasets, which takes more memory than all else and should come first.
/// `areInCells`: may be empty.
BoundaryFaces boundaryOf(Faces faces, const CellsTest& areInCells, Sheets sheets,
  const WorkProgress& progress = WorkProgress(), Extent extent = Extent::Volume);

/// Tests places in several threads; those that are not finite are in no cell.
CellsTest testInParallel(const CellTest& isInCell, const WorkProgress& progress);

/// Returns the scalars at points of these leaves, or of others on the same mesh.
std::vector<double> valuesAt(
  const std::vector<LeafPoint>& points, const std::vector<vtkDataSet*>& leaves);

} // namespace filters
