// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Triangles.h"
#include "Walls/MeshFaces.h"

#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkDataSet;

namespace filters
{

/// Treatment of boundaries of the gas.
enum class Outside
{
  Auto,   ///< bodies and sheets are walls, outer boundaries are not: see OutsidePlaces
  Blocks, ///< all boundaries are walls
  Passes  ///< only hidden cells and Bodies are walls
};

/// Extent of cells: the whole data, or a layer of data that do not depend on z, at whose sides
/// across z nothing ends.
enum class Extent
{
  Volume,
  Layer
};

/// The boundary of the gas: faces of one visible cell only.
struct BoundaryFaces
{
  Triangles surface;                      ///< normals point into the gas
  std::vector<LeafPoint> origins;         ///< of its points
  std::vector<unsigned char> hidesBehind; ///< of each triangle: whether a hidden cell is behind it
  std::vector<Triangles::Corners> ends;   ///< of hidden cells, where no cell follows
  Extent extent = Extent::Volume;
};

/**
 * Finds the boundary of all leaves together: datasets with a double scalar at each point, NaN
 * without gas. Cells are visible if they are 3-D and not hidden by a ghost array (hiddenCellBits).
 * Cells with a point without gas are hidden; cells with a point that is not finite are omitted.
 *
 * Merges faces with the same points, also where points of several datasets coincide (see
 * coincidentPoints()). Omits faces without area, at a pole or an axis.
 *
 * Sheets are walls without thickness: faces at the same place of cells of one dataset that have
 * points of their own there, because withSharedPoints() has left them apart. Others, whose cells share
 * points, are not recognized.
 */
class OpenFaces
{
public:
  using Flags = std::vector<unsigned char>;

  /// `faces`: facesOf() the datasets, which takes more memory than all else and should come first.
  explicit OpenFaces(Faces faces, Extent extent = Extent::Volume);

  /// Return places behind the middles of the faces, and behind the corners of those whose middle a
  /// visible cell contains.
  std::vector<Point> middles() const;
  std::vector<Point> corners(const Flags& areMiddlesInCells) const;
  /// Removes faces with cells on both sides whose points differ, given which of these places visible
  /// cells contain: of overlapping blocks, hanging nodes, curved sides of blocks with a gap of up to
  /// 0.05 of the cell's height or the face's smallest edge.
  void removeCovered(const Flags& areMiddlesInCells, const Flags& areCornersInCells);

  /// Returns the faces; unless light passes, with sheets, once from each side.
  BoundaryFaces boundary(Outside outside) const;

private:
  /// A face seen from its cell.
  struct Sides
  {
    Point middle;
    Point outward; // unit length, or 0
    double height; // approximate height of the cell above the face
    double width;  // smallest edge
  };
  /// A face with visible cells on one side only.
  struct Face
  {
    std::vector<std::int32_t> corners; // seen from the gas, counter-clockwise
    Sides sides;
    bool hidesBehind;
  };

  Sides sidesOf(std::size_t face) const;
  std::vector<std::int32_t> mergePoints();
  std::vector<std::int32_t> distinctCorners(std::size_t face) const;
  Face openFaceOf(std::size_t face, bool hidesBehind) const;
  bool isSheet(const std::vector<std::int32_t>& before, std::size_t one, std::size_t other) const;
  void removePairs(const std::vector<std::int32_t>& before);
  static Point behind(const Face& face);

  Faces All;
  Extent Ends;
  double Rounding; // see relativeRounding()
  std::vector<Face> Open, Sheets, Hidden;
};

/// Returns the scalars at points of these leaves, or of others on the same mesh.
std::vector<double> valuesAt(
  const std::vector<LeafPoint>& points, const std::vector<vtkDataSet*>& leaves);

} // namespace filters
