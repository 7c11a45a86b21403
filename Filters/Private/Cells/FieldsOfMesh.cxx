// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/FieldsOfMesh.h"

#include "vtkDataSet.h"

#include <cstdint>
#include <limits>

namespace filters
{

void FieldsOfMesh::add(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
  const std::shared_ptr<const CellTree::Mesh>& mesh, const WorkProgress& progress)
{
  const std::vector<vtkDataSet*> pointers(leaves.begin(), leaves.end());
  this->Fields.push_back(
    std::unique_ptr<const Field>(new Field{ leaves, CellTree(pointers, mesh, progress) }));
}

schlieren::MediumSource::FieldRange FieldsOfMesh::rangeOf(
  int field, const schlieren::Box& box) const
{
  const CellTree& cells = this->Fields[static_cast<std::size_t>(field)]->cells;
  const CellTree::Content content = cells.content({ box.low, box.high });
  return { content.lowest, content.highest };
}

void FieldsOfMesh::sample(
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

} // namespace filters
