// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/KeptMesh.h"

#include "Cells/MeshKey.h"

#include <utility>

namespace filters
{

void KeptMesh::beginStep()
{
  this->lattices = this->lattices ? this->lattices : std::make_shared<LatticesOfMesh>();
  this->lattices->beginStep();
}

void leave(std::shared_ptr<KeptMesh>& kept)
{
  if (kept.use_count() > 1)
  {
    const vtkTypeInt64 builds = kept->builds;
    kept = std::make_shared<KeptMesh>();
    kept->builds = builds;
  }
  kept->release();
}

std::uint64_t keyOfWalls(Outside outside, vtkDataObject* bodies)
{
  Hash hash;
  hash.add(static_cast<std::uint64_t>(outside));
  addBodies(hash, bodies);
  return hash.value();
}

std::shared_ptr<const PieceSource> sourceOfMeshes(const PreparedLeaves& prepared,
  const MeshChoices& choices, vtkDataObject* bodies, const WorkProgress& progress,
  std::shared_ptr<KeptMesh>& kept)
{
  const std::vector<vtkDataSet*> leaves = pointersTo(prepared.refractivity);
  const auto mesh = PieceMesh::of(prepared.refractivity, choices.reconstruction, kept->piece);
  const std::vector<std::uint64_t> keys{ mesh->key, keyOfWalls(choices.outside, bodies) };
  if (kept->keys != keys)
  {
    leave(kept);
  }
  const bool isNew = !kept->boundary;
  kept->builds += isNew ? 1 : 0;
  // Finds faces first, because that takes most memory.
  Faces faces = isNew ? facesOf(leaves, progress.part(0, 0.2)) : Faces();
  auto piece = std::make_unique<MeshPiece>(
    prepared, mesh, Copies::Used, isNew ? progress.part(0.2, 0.8) : progress, choices.flatAxis);
  if (isNew)
  {
    const CellsTest areInCells = testInParallel(
      [&](const Point& place) { return piece->holds(place); }, progress.part(0.84, 0.91));
    kept->boundary = std::make_shared<const GasBoundary>(std::move(faces), bodies, choices.outside,
      areInCells, progress.part(0.8, 1), choices.flatAxis < 0 ? Extent::Volume : Extent::Layer);
    kept->piece = mesh;
    kept->keys = keys;
  }
  else
  {
    kept->beginStep();
  }
  return std::make_shared<PieceSource>(
    std::move(piece), kept->boundary, kept->boundary->ambient(leaves), kept->lattices);
}

} // namespace filters
