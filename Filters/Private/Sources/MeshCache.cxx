// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/MeshCache.h"

#include "Cells/MeshKey.h"

#include <utility>

namespace filters
{

void MeshCache::beginStep()
{
  this->lattices = this->lattices ? this->lattices : std::make_shared<LatticeCache>();
  this->lattices->beginStep();
}

void leave(std::shared_ptr<MeshCache>& cache)
{
  if (cache.use_count() > 1)
  {
    const vtkTypeInt64 builds = cache->builds;
    cache = std::make_shared<MeshCache>();
    cache->builds = builds;
  }
  cache->release();
}

std::uint64_t keyOfWalls(Outside outside, vtkDataObject* bodies)
{
  Hash hash;
  hash.add(static_cast<std::uint64_t>(outside));
  addBodies(hash, bodies);
  return hash.value();
}

namespace
{

std::shared_ptr<const GasBoundary> boundaryOf(Faces faces, const MeshPiece& piece,
  const MeshChoices& choices, vtkDataObject* bodies, const WorkProgress& progress)
{
  OpenFaces open(std::move(faces), choices.flatAxis < 0 ? Extent::Volume : Extent::Layer);
  progress.reach(0.2);
  const OpenFaces::Flags middles = piece.hold(open.middles(), progress.part(0.2, 0.5));
  open.removeCovered(middles, piece.hold(open.corners(middles), progress.part(0.5, 0.6)));
  return std::make_shared<const GasBoundary>(
    open.boundary(choices.outside), bodies, choices.outside, progress.part(0.7, 1));
}

} // namespace

std::shared_ptr<const PieceSource> sourceOfMeshes(const MeshLeaves& prepared,
  const MeshChoices& choices, vtkDataObject* bodies, const WorkProgress& progress,
  std::shared_ptr<MeshCache>& cache)
{
  const std::vector<vtkDataSet*> leaves = pointersTo(prepared);
  const auto mesh = PieceMesh::of(prepared, cache->piece);
  const std::vector<std::uint64_t> keys{ mesh->key, keyOfWalls(choices.outside, bodies) };
  if (cache->keys != keys)
  {
    leave(cache);
  }
  const bool isNew = !cache->boundary;
  cache->builds += isNew ? 1 : 0;
  // Finds faces first, because that takes most memory.
  Faces faces = isNew ? facesOf(leaves, progress.part(0, 0.2)) : Faces();
  auto piece = std::make_unique<MeshPiece>(
    prepared, mesh, Copies::Used, isNew ? progress.part(0.2, 0.8) : progress, choices.flatAxis);
  if (isNew)
  {
    cache->boundary = boundaryOf(std::move(faces), *piece, choices, bodies, progress.part(0.8, 1));
    cache->piece = mesh;
    cache->keys = keys;
  }
  else
  {
    cache->beginStep();
  }
  return std::make_shared<PieceSource>(
    std::move(piece), cache->boundary, cache->boundary->ambient(leaves), cache->lattices);
}

} // namespace filters
