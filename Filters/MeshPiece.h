// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CellSampler.h"
#include "CellTree.h"
#include "MeshFaces.h"

#include "vtkSmartPointer.h"

#include "Medium/MediumSource.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkDataSet;

namespace filters
{

/// Whether two boxes have a point in common.
bool meet(const schlieren::Box& a, const schlieren::Box& b);

/// What one rank has of meshes that are spread over several: its own cells. Copies of other ranks' cells around them give
/// the points between them the values and trends that they would have in one mesh.
class MeshPiece
{
public:
  /// `leaves`: with N at their points, see preparedLeaves(). May be none.
  MeshPiece(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
    CellTree::Reconstruction reconstruction, const WorkProgress& progress = WorkProgress());

  /// Of all cells.
  struct Summary
  {
    std::int64_t cells;
    schlieren::Box bounds;
    CellTree::Content content;
  };
  Summary summary() const;
  CellTree::Sizes sizes() const { return this->Cells.measuredSizes(); }
  std::string warning() const;

  /// The faces of its own cells, and N at their points.
  Faces faces() const;
  std::vector<double> valuesAt(const Faces& faces) const;

  /// For boxes; see CellTree::content().
  std::vector<CellTree::Content> contents(const std::vector<schlieren::Box>& boxes) const;

  /// Whether its cells hold places.
  std::vector<unsigned char> hold(const std::vector<Point>& places) const;

  /// See CellSampler::sample(). `found` is empty where no point is.
  struct Samples
  {
    std::vector<unsigned char> found;
    std::vector<double> values;
  };
  Samples sample(const schlieren::Lattice& lattice) const;

private:
  bool meets(const schlieren::Box& box) const;

  std::vector<vtkSmartPointer<vtkDataSet>> Leaves;
  CellTree Cells;
  CellSampler Values;
};

} // namespace filters
