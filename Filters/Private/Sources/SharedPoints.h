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

class MeshArrays;

/**
 * Merges points of datasets of an input that coincide (see CoincidentPoints.h): those of blocks, of
 * appended meshes, and of the cells of discontinuous finite elements, so that cells become
 * neighbours.
 *
 * Walls without thickness within a dataset stay: points on both sides of sheets (see SheetFaces.h)
 * are kept apart. Sheets are searched for between large sets of cells that are connected by points,
 * because in discontinuous elements values jump between cells wherever the field is steep.
 */
class SharedPoints
{
public:
  /// Takes datasets with values in the cells' scalars or else in the points', with cells without
  /// gas hidden. `dimension`: of the cells in use. `kinds`: of the datasets; different kinds share
  /// no points; empty: all may.
  SharedPoints(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, int dimension,
    const std::vector<std::vector<bool>>& kinds = {});

  /// Returns unchanged those datasets that share no points, and a mesh for each connected group of
  /// others. Merged points have the mean of their values, or the cells' means if each cell has its
  /// own points and values jump. `leaves`: as in the constructor, perhaps with other values.
  std::vector<vtkSmartPointer<vtkDataSet>> joined(
    const std::vector<vtkSmartPointer<vtkDataSet>>& leaves) const;

private:
  /// Datasets that become one.
  struct Group
  {
    std::vector<std::size_t> leaves;
    std::vector<std::vector<std::int32_t>> numbers;    // of each leaf's points, in the mesh
    std::vector<std::vector<unsigned char>> isLeftOut; // of each leaf's cells; empty: none
    vtkIdType points = 0, cells = 0;
    bool areAllApart = false;                  // whether each cell has its own points
    vtkSmartPointer<vtkUnstructuredGrid> mesh; // without values
  };

  static std::vector<unsigned char> leaveOutDuplicates(
    const std::vector<MeshArrays>& meshes, Group& group);
  void addGroup(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, Group group);
  static vtkSmartPointer<vtkDataSet> joinedOf(
    const Group& group, const std::vector<vtkSmartPointer<vtkDataSet>>& leaves);

  std::vector<Group> Groups; // by their first leaves
};

} // namespace filters
