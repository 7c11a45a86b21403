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

/// What cells are: all that there is, or a layer of what does not depend on z. Nothing ends at the sides of a layer
/// across z.
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

/// The boundary of all leaves together: datasets with a double scalar at each point, NaN where there is no gas.
/// Cells are visible if they are 3-D and not hidden by a ghost array (hiddenCellBits). Those with a point without gas
/// count as hidden; those with a point that is nowhere (NaN) are not there.
///
/// Faces with the same points count as one, also where the points are there twice (blocks; the seam of an O-grid;
/// the wake cut of a C-grid): points are one if they lie within 1e-3 of the smallest edge or cell beside them, or
/// within the rounding of the coordinates. Faces without area, at a pole or an axis, are left out. With a
/// `isInCell`, so are faces that have cells on both sides without the same points: blocks that overlap, hanging
/// nodes, curved sides of blocks with a gap of up to 0.05 of the cell's height or the face's smallest edge.
///
/// Sheets without thickness within a dataset, whose cells meet at the same places but have points of their own on
/// both sides, are known by their values (see findSheets()) and are there twice, once from each side. Others are not
/// known to be there: give them as Bodies.
BoundaryFaces boundaryOf(const std::vector<vtkDataSet*>& leaves, const CellTest& isInCell,
  const WorkProgress& progress = WorkProgress(), Extent extent = Extent::Volume,
  Sheets sheets = Sheets::Found);

/// Faces that visible cells have on both sides, each side with points of its own: of one leaf, or of two, which `leaf` of the
/// contributions says.
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
