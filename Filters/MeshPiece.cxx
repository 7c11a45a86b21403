// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshPiece.h"

#include "BoundaryFaces.h"
#include "InvertedCells.h"
#include "LatticeDistances.h"
#include "MeshSource.h"

#include "vtkDataSet.h"
#include "vtkSMPTools.h"

#include <algorithm>

namespace filters
{

namespace
{

std::vector<vtkDataSet*> pointersTo(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves)
{
  return { leaves.begin(), leaves.end() };
}

/// Calls work(i) for i < count from several threads.
template <class Work>
void forEach(std::size_t count, const Work& work)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(count), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      {
        work(i);
      }
    });
}

} // namespace

bool meet(const schlieren::Box& a, const schlieren::Box& b)
{
  bool meet = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    meet = meet && a.low[axis] <= b.high[axis] && b.low[axis] <= a.high[axis];
  }
  return meet;
}

MeshPiece::MeshPiece(const std::vector<vtkSmartPointer<vtkDataSet>>& leaves,
  CellTree::Reconstruction reconstruction, const WorkProgress& progress)
  : Leaves(leaves)
  , Cells(pointersTo(leaves), reconstruction, progress, Copies::Neighbours)
  , Values(this->Cells)
{
}

MeshPiece::Summary MeshPiece::summary() const
{
  return { static_cast<std::int64_t>(this->Cells.size()), boundsOf(this->Cells, this->Leaves),
    this->Cells.content(this->Cells.bounds()) };
}

std::string MeshPiece::warning() const { return warningOfInvertedCells(this->Cells); }

Faces MeshPiece::faces() const
{
  return facesOf(pointersTo(this->Leaves), WorkProgress(), Copies::Neighbours);
}

std::vector<double> MeshPiece::valuesAt(const Faces& faces) const
{
  return filters::valuesAt(faces.firstContributions, faces.contributions, pointersTo(this->Leaves));
}

bool MeshPiece::meets(const schlieren::Box& box) const
{
  const CellTree::Bounds& bounds = this->Cells.bounds();
  return this->Cells.size() > 0 && meet(box, { bounds.low, bounds.high });
}

std::vector<CellTree::Content> MeshPiece::contents(const std::vector<schlieren::Box>& boxes) const
{
  std::vector<CellTree::Content> contents(boxes.size());
  forEach(boxes.size(),
    [&](std::size_t i) {
      contents[i] = this->Cells.content({ boxes[i].low, boxes[i].high });
    });
  return contents;
}

std::vector<unsigned char> MeshPiece::hold(const std::vector<Point>& places) const
{
  std::vector<unsigned char> are(places.size(), 0);
  forEach(places.size(),
    [&](std::size_t i)
    {
      const Point& place = places[i];
      double value = 0;
      if (this->meets({ place, place }))
      {
        this->Values.sample({ place, { 1, 1, 1 }, { 1, 1, 1 } }, &value, &are[i]);
      }
    });
  return are;
}

MeshPiece::Samples MeshPiece::sample(const schlieren::Lattice& lattice) const
{
  Samples samples;
  if (!this->meets(boxAround(lattice, 0)))
  {
    return samples;
  }
  const auto size = static_cast<std::size_t>(lattice.size());
  samples.found.resize(size);
  samples.values.resize(size);
  this->Values.sample(lattice, samples.values.data(), samples.found.data());
  if (std::none_of(
        samples.found.begin(), samples.found.end(), [](unsigned char is) { return is != 0; }))
  {
    samples = {};
  }
  return samples;
}

} // namespace filters
