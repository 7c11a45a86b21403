// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellSampler.h"
#include "Cells/CellTree.h"
#include "Common/WorkProgress.h"

#include "Schlieren.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <memory>
#include <vector>

class vtkDataSet;

namespace filters
{

/// Further fields at the points of meshes, whose gradients rays may gather.
class FieldsOfMesh
{
public:
  /// `leaves`: the same meshes as those of `mesh`, with the field in the place of N, NaN where it has no values.
  void add(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
    const std::shared_ptr<const CellTree::Mesh>& mesh,
    const WorkProgress& progress = WorkProgress());

  int count() const { return static_cast<int>(this->Fields.size()); }
  /// See MediumSource.
  schlieren::MediumSource::FieldRange rangeOf(int field, const schlieren::Box& box) const;
  /// In the cells that hold the lattice's points; field after field, NaN where a field has no value.
  void sample(const schlieren::Lattice& lattice, const CellsOfLattice& cells, double* values) const;

private:
  struct Field
  {
    std::vector<vtkSmartPointer<vtkDataSet>> leaves;
    CellTree cells;
  };
  std::vector<std::unique_ptr<const Field>> Fields;
};

} // namespace filters
