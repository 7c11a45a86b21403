// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/MeshPiece.h"

#include "Cells/MeshKey.h"
#include "Common/Message.h"
#include "Input/FlatData.h"
#include "Walls/BoundaryFaces.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace filters
{

std::shared_ptr<PieceMesh> PieceMesh::of(
  const MeshLeaves& leaves, const std::shared_ptr<PieceMesh>& kept)
{
  Hash hash;
  for (vtkDataSet* leaf : leaves)
  {
    addMesh(hash, leaf);
    addGas(hash, leaf);
  }
  return kept && kept->key == hash.value()
    ? kept
    : std::make_shared<PieceMesh>(PieceMesh{ hash.value(), nullptr, {} });
}

MeshPiece::MeshPiece(MeshLeaves leaves, std::shared_ptr<PieceMesh> mesh, Copies copies,
  const WorkProgress& progress, int flatAxis)
  : Leaves(std::move(leaves))
  , Mesh(std::move(mesh))
  , Cells(this->Mesh->cells
        ? CellTree(pointersTo(this->Leaves), this->Mesh->cells, progress)
        : CellTree(pointersTo(this->Leaves), CellTree::Reconstruction::Smooth, progress, copies))
  , Values(this->Cells)
  , FlatAxis(flatAxis)
{
  this->Mesh->cells = this->Cells.mesh();
}

DataPiece::Facts MeshPiece::facts() const
{
  return { static_cast<std::int64_t>(this->Cells.size()), this->bounds(),
    this->Cells.content(this->Cells.bounds()), this->Cells.voxelShape(),
    directionAcross(this->FlatAxis), this->FlatAxis >= 0 };
}

/// Returns the bounds of visible cells; with hidden cells, which are bodies, those of all points.
schlieren::Box MeshPiece::bounds() const
{
  schlieren::Box box{ this->Cells.bounds().low, this->Cells.bounds().high };
  vtkIdType all = 0;
  for (vtkDataSet* leaf : this->Leaves)
  {
    all += leaf->GetNumberOfCells();
  }
  const bool hidesNone = this->Cells.size() + this->Cells.copies() == static_cast<std::size_t>(all);
  for (vtkDataSet* leaf : this->Cells.size() == 0 || hidesNone ? MeshLeaves() : this->Leaves)
  {
    const double* bounds = leaf->GetBounds();
    if (std::all_of(bounds, bounds + 6, [](double x) { return std::isfinite(x); }))
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        box.low[axis] = std::min(box.low[axis], bounds[2 * axis]);
        box.high[axis] = std::max(box.high[axis], bounds[2 * axis + 1]);
      }
    }
  }
  return box;
}

CellTree::Content MeshPiece::contentOf(const schlieren::Box& box) const
{
  return this->Cells.content({ box.low, box.high });
}

bool MeshPiece::holds(const Point& place) const
{
  unsigned char isHeld = 0;
  double value = 0;
  this->Values.sample({ place, { 1, 1, 1 }, { 1, 1, 1 } }, &value, &isHeld);
  return isHeld != 0;
}

void MeshPiece::sample(const schlieren::Lattice& lattice, double* refractivity,
  unsigned char* found, CellsOfLattice* cells) const
{
  this->Values.sample(lattice, refractivity, found, cells);
}

bool MeshPiece::sampleIn(
  const CellsOfLattice& cells, const schlieren::Lattice& lattice, double* refractivity) const
{
  return this->Values.sample(lattice, cells, refractivity);
}

/// Finds the faces, and keeps the origins of their points.
Faces MeshPiece::findFaces() const
{
  Faces faces = facesOf(pointersTo(this->Leaves), WorkProgress(), Copies::Neighbours);
  this->Mesh->boundaryPoints = faces.origins;
  return faces;
}

void MeshPiece::putBoundary(std::int64_t cellsOfAll, std::vector<char>& message) const
{
  const Faces faces = this->findFaces();
  putAll(this->Cells.measuredCells(cellsOfAll), message);
  putAll(faces.points, message);
  std::vector<std::uint32_t> leaves;
  for (const LeafPoint& origin : faces.origins)
  {
    leaves.push_back(origin.leaf);
  }
  putAll(leaves, message);
  putAll(faces.areDoubles, message);
  putAll(faces.corners, message);
  putAll(faces.starts, message);
  putAll(faces.owners, message);
  putAll(faces.states, message);
}

void MeshPiece::putBoundaryValues(std::vector<char>& message) const
{
  if (!this->Mesh->boundaryPoints)
  {
    this->findFaces();
  }
  putAll(valuesAt(*this->Mesh->boundaryPoints, pointersTo(this->Leaves)), message);
}

void BoundaryOfMeshes::add(Reader& reader)
{
  Faces& all = this->faces;
  const auto firstPoint = static_cast<std::int32_t>(all.points.size());
  const std::size_t firstCorner = all.corners.size();
  reader.AddAll(this->cells);
  const auto points = reader.GetAll<std::vector<Point>>();
  const auto leavesOfRank = reader.GetAll<std::vector<std::uint32_t>>();
  const auto areDoubles = reader.GetAll<std::vector<unsigned char>>();
  const std::uint32_t firstLeaf = this->leaves;
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    const std::uint32_t leaf = firstLeaf + leavesOfRank.at(n);
    this->leaves = std::max(this->leaves, leaf + 1);
    const auto number = static_cast<vtkIdType>(all.points.size());
    all.addPoint(points[n], { leaf, number }, areDoubles.at(n) != 0);
  }
  for (const std::int32_t corner : reader.GetAll<std::vector<std::int32_t>>())
  {
    all.corners.push_back(firstPoint + corner);
  }
  const auto starts = reader.GetAll<std::vector<std::size_t>>();
  for (std::size_t face = 1; face < starts.size(); ++face)
  {
    all.starts.push_back(firstCorner + starts[face]);
  }
  reader.AddAll(all.owners);
  reader.AddAll(all.states);
}

} // namespace filters
