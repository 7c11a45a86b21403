// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Walls/MeshFaces.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filters
{

/// Faces with cells of one dataset on both sides, each with points of its own: the seam of an
/// O-grid or the wake cut of a C-grid, with equal values, or a wall without thickness.
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
 * Returns which faces are walls (1), by the values of both sides: parts connected at corners whose
 * values differ by more than a thousandth of the whole range at all points with two values, and by
 * more than a fiftieth on half of the area. So a wing ends where the cut does, or where its sides'
 * values are equal, and small differences by rounding or interpolation make no wall. `values`: of
 * all contributions, see valuesOf().
 */
std::vector<unsigned char> findSheets(const CutFaces& cuts, const std::vector<double>& values);

} // namespace filters
