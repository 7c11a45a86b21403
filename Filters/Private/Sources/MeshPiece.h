// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellSampler.h"
#include "Cells/CellTree.h"
#include "Cells/FieldsOfMesh.h"
#include "Sources/DataPiece.h"
#include "Walls/MeshFaces.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkDataSet;

namespace filters
{

/// What of a piece depends on its mesh alone, and not on the values: it is kept from one time step to the next.
struct PieceMesh
{
  std::uint64_t key; // see DataPiece::meshKey()
  std::shared_ptr<const CellTree::Mesh> cells;
  // Contributions to boundary values, see Faces; empty: not computed.
  std::vector<std::size_t> firstContributions;
  std::vector<Contribution> contributions;
};

/// What one rank has of meshes that are spread over several: its own cells. Copies of other ranks' cells around them (see
/// PartsOfRanks) give the points between them the values and trends that they would have in one mesh.
class MeshPiece : public DataPiece
{
public:
  /// `leaves`: with N at their points, see preparedLeaves(). May be none. `kept`: of another piece, which may be of the same
  /// mesh; may be null. `datasets`: of each leaf a number that its parts on other ranks have, too; none: these have no parts.
  MeshPiece(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
    CellTree::Reconstruction reconstruction, const std::shared_ptr<PieceMesh>& kept = nullptr,
    std::vector<std::uint32_t> datasets = {});
  std::shared_ptr<PieceMesh> mesh() const { return this->Mesh; }

  /// Adds a field of its cells; see FieldsOfMesh.
  void addField(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves)
  {
    this->Fields.add(leaves, this->Cells.mesh());
  }

  Summary summary() const override;
  std::uint64_t meshKey() const override { return this->Mesh->key; }
  /// Writes some cells' sizes, the faces of its own cells, and N at their points.
  void putBoundary(std::int64_t cellsOfAll, std::vector<char>& message) const override;
  void putBoundaryValues(std::vector<char>& message) const override;
  CellTree::Content contentOf(const schlieren::Box& box) const override;
  bool holds(const Point& place) const override;
  int fields() const override { return this->Fields.count(); }
  schlieren::MediumSource::FieldRange rangeOfField(
    int field, const schlieren::Box& box) const override
  {
    return this->Fields.rangeOf(field, box);
  }
  Samples sample(const schlieren::Lattice& lattice) const override;

private:
  Faces findFaces() const;
  bool meets(const schlieren::Box& box) const;

  std::vector<vtkSmartPointer<vtkDataSet>> Leaves;
  std::vector<std::uint32_t> Datasets;
  std::shared_ptr<PieceMesh> Mesh;
  CellTree Cells;
  CellSampler Values;
  FieldsOfMesh Fields;
};

} // namespace filters
