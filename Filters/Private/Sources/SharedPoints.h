// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkDataSet;

namespace filters
{

/**
 * Merges points of datasets of an input that coincide (see CoincidentPoints.h): those of blocks, of
 * appended meshes, of grids that meet themselves, and of the cells of discontinuous finite elements,
 * so that cells become neighbours. Returns unchanged those datasets that share no points, and a mesh
 * of all others, whose merged points have the mean of their values.
 *
 * Takes datasets with values in the cells' scalars or else in the points', with cells without gas
 * hidden. Walls without thickness within a dataset stay: the points of their two sides have
 * different values, and are kept apart.
 */
std::vector<vtkSmartPointer<vtkDataSet>> withSharedPoints(
  const std::vector<vtkSmartPointer<vtkDataSet>>& leaves);

/// Datasets that become one.
struct JoinedLeaves
{
  std::vector<std::size_t> leaves;
  std::vector<std::vector<std::int32_t>> points; // of each leaf's points, numbers in the mesh
  std::size_t count = 0;                         // of the mesh's points
  std::vector<std::int32_t> doubles;             // of these: several of one leaf
};
/// Makes the mesh of those that are named among `leaves`.
vtkSmartPointer<vtkDataSet> meshOf(
  const JoinedLeaves& joined, const std::vector<vtkSmartPointer<vtkDataSet>>& leaves);

} // namespace filters
