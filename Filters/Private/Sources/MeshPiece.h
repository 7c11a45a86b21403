// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/CellSampler.h"
#include "Cells/CellTree.h"
#include "Common/WorkProgress.h"
#include "Sources/DataPiece.h"
#include "Sources/PreparedLeaves.h"
#include "Walls/MeshFaces.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

class vtkDataSet;

namespace filters
{

class Reader;

/// The state of a piece that depends on its mesh alone, kept from one time step to the next. It
/// needs no dataset.
struct PieceMesh
{
  std::uint64_t key;                                    ///< see DataPiece::meshKey()
  std::shared_ptr<const CellTree::Mesh> cells;          ///< null: not yet made
  std::optional<std::vector<LeafPoint>> boundaryPoints; ///< see Faces; unset: not computed

  /// Returns that of the leaves: `kept` (may be null) if it is equal, or a new one.
  static std::shared_ptr<PieceMesh> of(
    const MeshLeaves& leaves, const std::shared_ptr<PieceMesh>& kept);
};

/// Meshes, or the cells that a rank has of meshes in pieces. There, copies of other ranks' cells
/// around them (see PiecesOfRanks) give the points between them the values and trends that they
/// would have in one mesh.
class MeshPiece : public DataPiece
{
public:
  /// `leaves`: may be none. `copies`: of cells, among the leaves'. `flatAxis`: the axis across which
  /// they were flat (see extruded()), or -1.
  MeshPiece(MeshLeaves leaves, std::shared_ptr<PieceMesh> mesh, Copies copies,
    const WorkProgress& progress = WorkProgress(), int flatAxis = -1);

  Facts facts() const override;
  CellTree::Content contentOf(const schlieren::Box& box) const override;
  bool holds(const Point& place) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, unsigned char* found,
    CellsOfLattice* cells) const override;
  bool sampleIn(const CellsOfLattice& cells, const schlieren::Lattice& lattice,
    double* refractivity) const override;

  std::uint64_t meshKey() const override { return this->Mesh->key; }
  /// Writes some cells' sizes and the faces of its own cells, for BoundaryOfMeshes. `cellsOfAll`:
  /// number of cells of all pieces.
  void putBoundary(std::int64_t cellsOfAll, std::vector<char>& message) const;
  /// Writes N at the points of these faces.
  void putBoundaryValues(std::vector<char>& message) const;

private:
  schlieren::Box bounds() const;
  Faces findFaces() const;

  MeshLeaves Leaves;
  std::shared_ptr<PieceMesh> Mesh;
  CellTree Cells;
  CellSampler Values;
  int FlatAxis;
};

/// What all ranks make of MeshPiece::putBoundary().
struct BoundaryOfMeshes
{
  std::vector<CellTree::MeasuredCell> cells;
  Faces faces;              ///< the origin of a point is its number among those of all ranks
  std::uint32_t leaves = 0; ///< of all ranks; those of a rank are others than another's

  /// Another rank's.
  void add(Reader& reader);
};

} // namespace filters
