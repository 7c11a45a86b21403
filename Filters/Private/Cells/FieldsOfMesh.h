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

/// Further fields at the points of meshes, for tints by their gradients.
class FieldsOfMesh
{
public:
  /// `leaves`: the meshes of `mesh`, with the field instead of N; NaN: no value.
  void add(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
    const std::shared_ptr<const CellTree::Mesh>& mesh,
    const WorkProgress& progress = WorkProgress());

  int count() const { return static_cast<int>(this->Fields.size()); }
  /// Returns the range of a field; see MediumSource.
  schlieren::MediumSource::FieldRange rangeOf(int field, const schlieren::Box& box) const;
  /// Interpolates in the lattice's cells, field after field; NaN where a field has no value.
  /// `cells`: null: to be searched.
  void sample(const schlieren::Lattice& lattice, const CellsOfLattice* cells, double* values) const;

private:
  struct Field
  {
    std::vector<vtkSmartPointer<vtkDataSet>> leaves;
    CellTree cells;
  };
  std::vector<std::unique_ptr<const Field>> Fields;
};

} // namespace filters
