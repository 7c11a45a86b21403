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
 * Which points of the datasets of an input are one. Blocks have points of their own where they meet, appended meshes
 * where these do, and in discontinuous finite elements each cell has. Where they coincide (see CoincidentPoints.h), cells
 * are neighbours: what is known of one is used for the other.
 *
 * Walls without thickness within a dataset stay: points on both sides of faces that are sheets (see SheetFaces.h) are
 * apart. They are looked for between cells that much of the dataset connects by points that they share. In discontinuous
 * elements values jump from cell to cell wherever the field is steep, which is no wall. A grid alone (the seam of an O-grid)
 * stays as it is, as do its parts on several ranks.
 */
class SharedPoints
{
public:
  /// Of datasets with values in the cells' scalars, or else in those of the points, cells without gas being hidden.
  /// `dimension`: of the cells that count. `kinds`: of the datasets, of which those of different kinds share no points;
  /// empty: all may.
  SharedPoints(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, int dimension,
    const std::vector<std::vector<bool>>& kinds = {});

  /// Those datasets as they are that share no points; of others one mesh for all that hang together. Points that are one
  /// have the mean of their values. Where each cell has its points for itself and the values jump, they become the cells'
  /// means. `leaves`: those of the constructor, or the same with other values.
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

  void addGroup(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, Group group);
  static vtkSmartPointer<vtkDataSet> joinedOf(
    const Group& group, const std::vector<vtkSmartPointer<vtkDataSet>>& leaves);

  std::vector<Group> Groups; // by their first leaves
};

} // namespace filters
