// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Walls/MeshFaces.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filters
{

/// Faces that cells of one dataset have on both sides, each side with points of its own: the seam of an O-grid or the
/// wake cut of a C-grid, across which values are the same; or a wall without thickness, where they are not.
struct CutFaces
{
  std::vector<std::size_t> firstContributions{
    0
  }; // of each value, and the end; two for each corner, one for each side
  std::vector<Contribution> contributions;
  std::vector<std::int32_t> places;     // of all faces' corners; equal for equal positions
  std::vector<std::size_t> starts{ 0 }; // of each face's corners, and the end
  std::vector<double> areas;            // of each face

  std::size_t size() const { return this->areas.size(); }
};

/**
 * Which of these faces are walls (1), by the values of both sides: parts that hang together at their corners, with values
 * that differ by more than a thousandth of the values' range at all points that both sides have of their own, and by more than a
 * fiftieth on half of the area. So a wing ends where the cut does, or where its sides' values are the same, and values that
 * rounding or interpolation have made differ a little are no wall. `values`: of all contributions, see valuesOf().
 */
std::vector<unsigned char> findSheets(const CutFaces& cuts, const std::vector<double>& values);

} // namespace filters
