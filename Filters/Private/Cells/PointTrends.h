// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/MeshArrays.h"
#include "Common/WorkProgress.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filters
{

/**
 * How a dataset's values continue around its points; nothing is known of points of no cell.
 *
 * Gradients are those of the quadratic polynomial that fits the values at the points of the same cells best
 * (where these are few, those around them, too), so those of a quadratic field are exact. Where it does not
 * fit well, as at a shock, they are made smaller.
 *
 * What is found once is which points these are, which is all that depends on the mesh alone. (The weights of the
 * fit would be ten times as many numbers, and are found faster than they are read.)
 */
class PointNeighbours
{
public:
  /// Uses cells whose `isCellUsed` is not 0.
  PointNeighbours(const MeshArrays& mesh, std::vector<unsigned char> isCellUsed,
    const WorkProgress& progress = WorkProgress());

  /// Returns trends for values on a mesh with the same points and cells.
  std::vector<PointTrend> trends(
    const MeshArrays& mesh, const WorkProgress& progress = WorkProgress()) const;

  /// The values at the points that are right for a mesh whose values are means over cells (see CellsAround): those of
  /// the polynomials whose means fit these best. Beyond the values of the cells around it goes only a point where all
  /// others nearby do so, too, at a smooth extremum, or where the field continues evenly, at the boundary: so there is no
  /// overshoot beside a shock.
  std::vector<double> valuesFromCells(
    const MeshArrays& mesh, const WorkProgress& progress = WorkProgress()) const;

  std::size_t bytes() const;

private:
  template <class Visit>
  void forNeighbours(
    const MeshArrays& mesh, vtkIdType begin, vtkIdType end, const Visit& visit) const;

  // Neighbours of the points of each chunk, see forChunks(), and where those of each point end in
  // it. Structured grids have none, whose cells are found as fast.
  std::vector<std::vector<std::uint32_t>> Chunks;
  std::vector<std::uint32_t> Ends;
  std::vector<unsigned char> IsCellUsed; // for structured grids
};

} // namespace filters
