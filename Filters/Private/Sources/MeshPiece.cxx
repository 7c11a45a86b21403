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

namespace
{

constexpr double ofTree = 0.7; // of the progress; the rest is of fields

} // namespace

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

MeshPiece::MeshPiece(const PreparedLeaves& leaves, std::shared_ptr<PieceMesh> mesh, Copies copies,
  const WorkProgress& progress, int flatAxis)
  : Leaves(leaves.refractivity)
  , Mesh(std::move(mesh))
  , Cells(this->Mesh->cells
        ? CellTree(pointersTo(this->Leaves), this->Mesh->cells, progress.part(0, ofTree))
        : CellTree(pointersTo(this->Leaves), CellTree::Reconstruction::Smooth,
            progress.part(0, ofTree), copies))
  , Values(this->Cells)
  , FlatAxis(flatAxis)
{
  this->Mesh->cells = this->Cells.mesh();
  const auto begunAt = [&](std::size_t number)
  {
    return ofTree +
      (1 - ofTree) * static_cast<double>(number) / static_cast<double>(leaves.fields.size());
  };
  for (std::size_t number = 0; number < leaves.fields.size(); ++number)
  {
    const MeshLeaves& field = leaves.fields[number];
    this->Fields.push_back(std::unique_ptr<const Field>(new Field{ field,
      CellTree(pointersTo(field), this->Cells.mesh(),
        progress.part(begunAt(number), begunAt(number + 1))) }));
  }
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
  unsigned char* found, double* fields, CellsOfLattice* cells) const
{
  CellsOfLattice ofFields;
  const bool isLarge = lattice.size() > CellsOfLattice::maxPoints;
  cells = cells || !fields || isLarge ? cells : &ofFields;
  this->Values.sample(lattice, refractivity, found, cells);
  if (fields)
  {
    this->sampleFields(lattice, cells, fields);
  }
}

bool MeshPiece::sampleIn(const CellsOfLattice& cells, const schlieren::Lattice& lattice,
  double* refractivity, double* fields) const
{
  const bool areSame = this->Values.sample(lattice, cells, refractivity);
  if (areSame && fields)
  {
    this->sampleFields(lattice, &cells, fields);
  }
  return areSame;
}

schlieren::MediumSource::FieldRange MeshPiece::rangeOfField(
  int field, const schlieren::Box& box) const
{
  const CellTree& cells = this->Fields[static_cast<std::size_t>(field)]->cells;
  const CellTree::Content content = cells.content({ box.low, box.high });
  return { content.lowest, content.highest };
}

/// Interpolates in the lattice's cells, field after field; NaN where a field has no value. `cells`:
/// null: to be searched.
void MeshPiece::sampleFields(
  const schlieren::Lattice& lattice, const CellsOfLattice* cells, double* values) const
{
  const auto size = static_cast<std::size_t>(lattice.size());
  std::vector<unsigned char> isFound(size, 0);
  for (const std::uint16_t point : cells ? cells->points : std::vector<std::uint16_t>())
  {
    isFound[point] = 1;
  }
  for (const auto& field : this->Fields)
  {
    const CellSampler sampler(field->cells);
    if (!cells || !sampler.sample(lattice, *cells, values))
    {
      sampler.sample(lattice, values, isFound.data());
    }
    for (std::size_t i = 0; i < size; ++i)
    {
      values[i] = isFound[i] ? values[i] : std::numeric_limits<double>::quiet_NaN();
    }
    values += size;
  }
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
