// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Triangles.h"
#include "Common/WorkProgress.h"
#include "Walls/MeshFaces.h"
#include "Walls/SheetFaces.h"

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

/// Treatment of walls without thickness within a dataset.
enum class Sheets
{
  Found,
  Ignored
};

/// The boundary of the gas: faces of one visible cell only.
struct BoundaryFaces
{
  Triangles surface;                       ///< normals point into the gas
  std::vector<std::size_t> starts{ 0 };    ///< of each point in `contributions`, and the end
  std::vector<Contribution> contributions; ///< to the value at the point
  std::vector<unsigned char> hidesBehind;  ///< of each triangle: whether a hidden cell is behind it
  Extent extent = Extent::Volume;
  CutFaces cuts;                        ///< within datasets, including sheets in `surface`
  std::vector<unsigned char> areSheets; ///< of `cuts`
};

/// Finds the boundary of all leaves together: datasets with a double scalar at each point, NaN
/// without gas. Cells are visible if they are 3-D and not hidden by a ghost array (hiddenCellBits).
/// Cells with a point without gas are hidden; cells with a point that is not finite are omitted.
///
/// Merges faces with the same points, also where points are duplicated (blocks; the seam of an
/// O-grid; the wake cut of a C-grid): points coincide within 1e-3 of the smallest edge or cell
/// beside them, or within rounding. Omits faces without area, at a pole or an axis, and, with
/// `isInCell`, faces with cells on both sides whose points differ: overlapping blocks, hanging
/// nodes, curved sides of blocks with a gap of up to 0.05 of the cell's height or the face's
/// smallest edge, or of 0.3 of the height where it closes at once (areBesideNarrowGaps()).
///
/// Sheets without thickness within a dataset, whose cells meet with points of their own on both
/// sides, are found by their values (see findSheets()), and are included once from each side.
/// Others are not recognized: give them as Bodies.
///
/// `faces`: facesOf(leaves), which takes more memory than all else and should come first.
BoundaryFaces boundaryOf(Faces faces, const std::vector<vtkDataSet*>& leaves,
  const CellTest& isInCell, const WorkProgress& progress = WorkProgress(),
  Extent extent = Extent::Volume, Sheets sheets = Sheets::Found);

/// Finds faces with visible cells on both sides, each with points of its own: of one leaf, or of
/// two, according to `leaf` of the contributions.
CutFaces cutFacesOf(const std::vector<vtkDataSet*>& leaves, const WorkProgress& progress);

/// Returns the values of CutFaces::contributions.
using ValuesOfCuts = std::function<std::vector<double>(const CutFaces& cuts)>;

/// Finds the boundary of given faces. `valuesOf`: may be empty, for no sheets.
BoundaryFaces boundaryOf(Faces faces, const CellsTest& areInCells, const ValuesOfCuts& valuesOf,
  const WorkProgress& progress = WorkProgress(), Extent extent = Extent::Volume);

/// Returns the scalars at the surface's points, of these leaves or others on the same mesh.
std::vector<double> valuesAt(const BoundaryFaces& faces, const std::vector<vtkDataSet*>& leaves);
/// Sums contributions of the scalars: those of value i are starts[i] to starts[i + 1].
std::vector<double> valuesAt(const std::vector<std::size_t>& starts,
  const std::vector<Contribution>& contributions, const std::vector<vtkDataSet*>& leaves);

} // namespace filters
