// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CellSampler.h"
#include "CellTree.h"
#include "DataPiece.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataSet;

namespace filters
{

/// What one rank has of meshes that are spread over several: its own cells. Copies of other ranks' cells around them give
/// the points between them the values and trends that they would have in one mesh.
class MeshPiece : public DataPiece
{
public:
  /// `leaves`: with N at their points, see preparedLeaves(). May be none.
  MeshPiece(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
    CellTree::Reconstruction reconstruction, const WorkProgress& progress = WorkProgress());

  Summary summary() const override;
  std::string warning() const override;
  /// Some cells' sizes, the faces of its own cells, and N at their points.
  void putBoundary(std::vector<char>& message) const override;
  CellTree::Content contentOf(const schlieren::Box& box) const override;
  bool holds(const Point& place) const override;
  Samples sample(const schlieren::Lattice& lattice) const override;

private:
  bool meets(const schlieren::Box& box) const;

  std::vector<vtkSmartPointer<vtkDataSet>> Leaves;
  CellTree Cells;
  CellSampler Values;
};

} // namespace filters
