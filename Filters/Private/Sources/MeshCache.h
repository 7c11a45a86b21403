// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/WorkProgress.h"
#include "Sources/MeshPiece.h"
#include "Sources/PieceSource.h"

#include "vtkType.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

class vtkDataObject;

namespace filters
{

/// The state of a medium that depends on meshes alone, kept for the next time step.
struct MeshCache
{
  std::vector<std::uint64_t> keys; ///< of the pieces of all ranks, and keyOfWalls()
  std::shared_ptr<PieceMesh> piece;
  std::shared_ptr<const GasBoundary> boundary; ///< null: nothing is kept
  std::shared_ptr<LatticeCache> lattices;      ///< null in the first time step
  // Over several ranks:
  std::vector<LeafPoint> origins; ///< of boundary points, among those of all ranks
  std::array<double, 3> voxelShape{};
  vtkTypeInt64 builds = 0; ///< number of different meshes

  void release() { *this = { {}, {}, {}, {}, {}, {}, this->builds }; }
  /// Begins a time step on the same mesh.
  void beginStep();
};

/// Releases what is kept, or leaves it to others that share it.
void leave(std::shared_ptr<MeshCache>& cache);

/// Hashes what boundaries of gas depend on beside meshes. `bodies`: may be null.
std::uint64_t keyOfWalls(Outside outside, vtkDataObject* bodies);

/// Choices for a source of meshes. `flatAxis`: see MeshPiece.
struct MeshChoices
{
  Outside outside;
  int flatAxis;
};

/// Makes the source of meshes, with what is kept if that depends on the same meshes, bodies and
/// choices, and keeps it otherwise. `bodies`: may be null.
std::shared_ptr<const PieceSource> sourceOfMeshes(const MeshLeaves& prepared,
  const MeshChoices& choices, vtkDataObject* bodies, const WorkProgress& progress,
  std::shared_ptr<MeshCache>& cache);

} // namespace filters
