// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/MeshSource.h"

#include "Cells/MeshKey.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace filters
{

namespace
{

/// Returns whether a cell contains a point.
bool holds(const CellSampler& cells, const Point& place)
{
  double value = 0;
  unsigned char isFound = 0;
  cells.sample({ place, { 1, 1, 1 }, { 1, 1, 1 } }, &value, &isFound);
  return isFound != 0;
}

} // namespace

std::vector<vtkDataSet*> pointersTo(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves)
{
  return { leaves.begin(), leaves.end() };
}

schlieren::Box boundsOf(
  const CellTree& cells, const std::vector<vtkSmartPointer<vtkDataSet>>& leaves)
{
  schlieren::Box box{ cells.bounds().low, cells.bounds().high };
  vtkIdType all = 0;
  for (vtkDataSet* leaf : leaves)
  {
    all += leaf->GetNumberOfCells();
  }
  if (cells.size() == 0 || cells.size() + cells.copies() == static_cast<std::size_t>(all))
  {
    return box;
  }
  for (vtkDataSet* leaf : leaves)
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

MeshSource::MeshSource(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
  vtkDataObject* bodies, Outside outside, CellTree::Reconstruction reconstruction,
  const WorkProgress& progress, int flatAxis)
  : Leaves(leaves)
  , Cells(pointersTo(leaves), reconstruction, progress.part(0, 0.6))
  , Values(this->Cells)
  , Boundary(std::make_shared<GasBoundary>(
      pointersTo(leaves), bodies, outside,
      [this](const Point& place) { return holds(this->Values, place); }, progress.part(0.6, 1),
      flatAxis < 0 ? Extent::Volume : Extent::Layer))
  , FlatAxis(flatAxis)
  , Ambient(this->Boundary->ambient(pointersTo(leaves)))
  , Bounds(boundsOf(this->Cells, leaves))
{
}

MeshSource::MeshSource(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
  const SourceMesh& mesh, const WorkProgress& progress, int flatAxis)
  : Leaves(leaves)
  , Cells(pointersTo(leaves), mesh.cells, progress)
  , Values(this->Cells)
  , Boundary(mesh.boundary)
  , Lattices(mesh.lattices ? mesh.lattices : std::make_shared<LatticesOfMesh>())
  , FlatAxis(flatAxis)
  , Ambient(this->Boundary->ambient(pointersTo(leaves)))
  , Bounds(boundsOf(this->Cells, leaves))
{
  this->Lattices->beginStep();
}

bool MeshSource::hasSameSheets(
  const SourceMesh& mesh, const std::vector<vtkSmartPointer<vtkDataSet>>& leaves)
{
  return mesh.boundary->hasSheetsOf([&](const CutFaces& cuts)
    { return valuesAt(cuts.firstContributions, cuts.contributions, pointersTo(leaves)); });
}

std::uint64_t MeshSource::keyOf(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
  vtkDataObject* bodies, Outside outside, CellTree::Reconstruction reconstruction)
{
  Hash hash;
  hash.add(static_cast<std::uint64_t>(outside));
  hash.add(static_cast<std::uint64_t>(reconstruction));
  for (vtkDataSet* leaf : leaves)
  {
    addMesh(hash, leaf);
    addGas(hash, leaf);
  }
  addBodies(hash, bodies);
  return hash.value();
}

bool MeshSource::meetsBodies() const { return this->Boundary->hasBodiesIn(this->bounds()); }

schlieren::Box MeshSource::bounds() const { return this->Bounds; }

double MeshSource::ambient() const
{
  if (!std::isnan(this->Ambient))
  {
    return this->Ambient;
  }
  const CellTree::Content all = this->Cells.content(this->Cells.bounds());
  return 0.5 * (all.lowest + all.highest);
}

std::array<double, 3> MeshSource::voxelShape() const { return this->Cells.voxelShape(); }

schlieren::MediumSource::Content MeshSource::contentOf(const schlieren::Box& box) const
{
  Content content{ 1, 0, {}, false, false, false };
  content.cellSize.fill(std::numeric_limits<double>::infinity());
  this->Boundary->findPlaces(
    box, [this](const Point& place) { return holds(this->Values, place); }, content);
  if (content.hasGas)
  {
    const CellTree::Content cells = this->Cells.content({ box.low, box.high });
    content.lowest = cells.lowest;
    content.highest = cells.highest;
    content.cellSize = cells.cellSize;
  }
  return content;
}

void MeshSource::addField(
  const std::vector<vtkSmartPointer<vtkDataSet>>& leaves, const WorkProgress& progress)
{
  this->Fields.add(leaves, this->Cells.mesh(), progress);
}

void MeshSource::sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances, double* values) const
{
  const auto size = static_cast<std::size_t>(lattice.size());
  const auto known = this->Lattices ? this->Lattices->find(lattice, distances) : nullptr;
  if (known && this->Values.sample(lattice, known->cells, refractivity))
  {
    known->copyTo(places, distances, size);
    if (values)
    {
      this->Fields.sample(lattice, known->cells, values);
    }
    return;
  }
  const bool isKept = this->Lattices && this->Lattices->hasRoomFor(lattice);
  CellsOfLattice cells;
  std::vector<unsigned char> isFound(size);
  this->Values.sample(lattice, refractivity, isFound.data(), isKept || values ? &cells : nullptr);
  this->Boundary->sample(lattice, isFound.data(), places, distances);
  if (values)
  {
    this->Fields.sample(lattice, cells, values);
  }
  if (isKept)
  {
    this->Lattices->keep(lattice, knownLattice(std::move(cells), places, distances, size));
  }
}

} // namespace filters
