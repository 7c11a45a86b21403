// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/MeshPiece.h"

#include "Cells/LatticeDistances.h"
#include "Input/DatasetPieces.h"
#include "Sources/MeshSource.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <utility>

namespace filters
{

namespace
{

/// Reuses the mesh of another piece if it is equal.
std::shared_ptr<PieceMesh> meshOf(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
  CellTree::Reconstruction reconstruction, const std::shared_ptr<PieceMesh>& kept)
{
  const std::uint64_t key = MeshSource::keyOf(leaves, nullptr, Outside::Passes, reconstruction);
  if (kept && kept->key == key)
  {
    return kept;
  }
  auto mesh = std::make_shared<PieceMesh>();
  mesh->key = key;
  return mesh;
}

} // namespace

MeshPiece::MeshPiece(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
  CellTree::Reconstruction reconstruction, const std::shared_ptr<PieceMesh>& kept,
  std::vector<std::uint32_t> datasets)
  : Leaves(leaves)
  , Datasets(std::move(datasets))
  , Mesh(meshOf(leaves, reconstruction, kept))
  , Cells(this->Mesh->cells
        ? CellTree(pointersTo(leaves), this->Mesh->cells)
        : CellTree(pointersTo(leaves), reconstruction, WorkProgress(), Copies::Neighbours))
  , Values(this->Cells)
{
  if (!this->Mesh->cells)
  {
    this->Mesh->cells = this->Cells.mesh();
  }
}

DataPiece::Summary MeshPiece::summary() const
{
  return { static_cast<std::int64_t>(this->Cells.size()), boundsOf(this->Cells, this->Leaves),
    this->Cells.content(this->Cells.bounds()) };
}

/// Finds the faces, and keeps their contributions.
Faces MeshPiece::findFaces() const
{
  Faces faces = facesOf(pointersTo(this->Leaves), WorkProgress(), Copies::Neighbours);
  this->Mesh->firstContributions = faces.firstContributions;
  this->Mesh->contributions = faces.contributions;
  return faces;
}

void MeshPiece::putBoundary(std::int64_t cellsOfAll, std::vector<char>& message) const
{
  const Faces faces = this->findFaces();
  put(BoundaryKind::OfMesh, message);
  putAll(this->Cells.measuredCells(cellsOfAll), message);
  putAll(faces.points, message);
  std::vector<std::uint32_t> datasets;
  for (std::size_t n = 0; n < faces.points.size(); ++n)
  {
    const std::size_t first = faces.firstContributions[n];
    datasets.push_back(faces.firstContributions[n + 1] != first + 1
        ? Contribution::ofSeveral
        : this->Datasets.at(faces.contributions[first].leaf));
  }
  putAll(datasets, message);
  putAll(faces.corners, message);
  putAll(faces.starts, message);
  putAll(faces.owners, message);
  putAll(faces.states, message);
  putAll(faces.areParts, message);
  this->putBoundaryValues(message);
}

void MeshPiece::putBoundaryValues(std::vector<char>& message) const
{
  if (this->Mesh->firstContributions.empty())
  {
    this->findFaces();
  }
  putAll(
    valuesAt(this->Mesh->firstContributions, this->Mesh->contributions, pointersTo(this->Leaves)),
    message);
}

bool MeshPiece::meets(const schlieren::Box& box) const
{
  const CellTree::Bounds& bounds = this->Cells.bounds();
  return this->Cells.size() > 0 && meet(box, { bounds.low, bounds.high });
}

CellTree::Content MeshPiece::contentOf(const schlieren::Box& box) const
{
  return this->Cells.content({ box.low, box.high });
}

bool MeshPiece::holds(const Point& place) const
{
  unsigned char isHeld = 0;
  double value = 0;
  if (this->meets({ place, place }))
  {
    this->Values.sample({ place, { 1, 1, 1 }, { 1, 1, 1 } }, &value, &isHeld);
  }
  return isHeld != 0;
}

DataPiece::Samples MeshPiece::sample(const schlieren::Lattice& lattice) const
{
  Samples samples;
  if (!this->meets(boxAround(lattice, 0)))
  {
    return samples;
  }
  const auto size = static_cast<std::size_t>(lattice.size());
  samples.found.resize(size);
  samples.values.resize(size);
  CellsOfLattice cells;
  this->Values.sample(lattice, samples.values.data(), samples.found.data(),
    this->Fields.count() > 0 ? &cells : nullptr);
  if (std::none_of(
        samples.found.begin(), samples.found.end(), [](unsigned char is) { return is != 0; }))
  {
    return {};
  }
  samples.fields.resize(static_cast<std::size_t>(this->Fields.count()) * size);
  this->Fields.sample(lattice, cells, samples.fields.data());
  return samples;
}

void BoundaryOfMeshes::add(Reader& reader)
{
  const auto measured = reader.GetAll<std::vector<CellTree::MeasuredCell>>();
  this->cells.insert(this->cells.end(), measured.begin(), measured.end());
  Faces more;
  more.points = reader.GetAll<std::vector<Point>>();
  const auto datasets = reader.GetAll<std::vector<std::uint32_t>>();
  more.corners = reader.GetAll<std::vector<std::int32_t>>();
  more.starts = reader.GetAll<std::vector<std::size_t>>();
  more.owners = reader.GetAll<std::vector<Point>>();
  more.states = reader.GetAll<std::vector<State>>();
  more.areParts = reader.GetAll<std::vector<unsigned char>>();
  const auto firstPoint = static_cast<std::int32_t>(faces.points.size());
  const std::size_t firstCorner = faces.corners.size();
  for (std::size_t n = 0; n < more.points.size(); ++n)
  {
    faces.contributions.push_back(
      { datasets.at(n), static_cast<vtkIdType>(faces.points.size()), 1 });
    faces.addPoint(more.points[n]);
  }
  for (const std::int32_t corner : more.corners)
  {
    faces.corners.push_back(firstPoint + corner);
  }
  for (std::size_t face = 0; face < more.size(); ++face)
  {
    faces.starts.push_back(firstCorner + more.starts[face + 1]);
  }
  faces.owners.insert(faces.owners.end(), more.owners.begin(), more.owners.end());
  faces.states.insert(faces.states.end(), more.states.begin(), more.states.end());
  faces.areParts.insert(faces.areParts.end(), more.areParts.begin(), more.areParts.end());
}

} // namespace filters
