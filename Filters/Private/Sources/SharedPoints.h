// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkDataSet;
class vtkUnstructuredGrid;

namespace filters
{

/**
 * Merges points of datasets of an input that coincide (see CoincidentPoints.h): those of blocks, of
 * appended meshes, of grids that meet themselves, and of the cells of discontinuous finite elements,
 * so that cells become neighbours.
 *
 * Walls without thickness within a dataset stay: the points of their two sides have different
 * values, and are kept apart.
 */
class SharedPoints
{
public:
  /// Takes datasets with values in the cells' scalars or else in the points', with cells without
  /// gas hidden. `kinds`: of the datasets; different kinds share no points; empty: all may.
  explicit SharedPoints(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
    const std::vector<std::vector<bool>>& kinds = {});

  /// Returns unchanged those datasets that share no points, and a mesh of all others of a kind. Merged points have the mean of their values. `leaves`: as in the constructor, perhaps
  /// with other values.
  std::vector<vtkSmartPointer<vtkDataSet>> joined(
    const std::vector<vtkSmartPointer<vtkDataSet>>& leaves) const;

private:
  /// Datasets that become one.
  struct Group
  {
    std::vector<std::size_t> leaves;
    // Of each leaf's points and cells, numbers in the mesh; -1: a cell that is left out.
    std::vector<std::vector<std::int32_t>> points, cells;
    std::vector<std::int32_t> doubles;         // of the mesh's points: several of one leaf
    vtkSmartPointer<vtkUnstructuredGrid> mesh; // without values
  };

  static void makeMesh(
    const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, std::size_t points, Group& group);
  static vtkSmartPointer<vtkDataSet> joinedOf(
    const Group& group, const std::vector<vtkSmartPointer<vtkDataSet>>& leaves);

  std::vector<Group> Groups;
};

} // namespace filters
