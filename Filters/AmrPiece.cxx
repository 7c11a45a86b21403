// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "AmrPiece.h"

#include "DataParts.h"

#include <algorithm>

namespace filters
{

DataPiece::Summary AmrPiece::summary() const
{
  return { this->Field.ownCells(), this->Field.ownBounds(),
    this->Field.contentOf(this->Field.bounds()), this->Field.reachOfContent() };
}

void AmrPiece::putBoundary(std::vector<char>& message) const
{
  const BoundaryFaces faces = this->Field.faces();
  put(BoundaryKind::OfAmr, message);
  putAll(faces.surface.points, message);
  putAll(faces.surface.corners, message);
  putAll(faces.hidesBehind, message);
  putAll(this->Field.outerValues(), message);
}

DataPiece::Samples AmrPiece::sample(const schlieren::Lattice& lattice) const
{
  if (!this->Field.mayHold(lattice))
  {
    return {};
  }
  Samples samples{ this->Field.gasAt(lattice), {} };
  const CellBox all{ { 0, 0, 0 }, lattice.points };
  CellBox part{ all.end, all.begin }; // around its own points
  std::size_t point = 0;
  forCells(all.begin, all.end,
    [&](int i, int j, int k)
    {
      if (samples.found[point++])
      {
        const CellBox here{ { i, j, k }, { i + 1, j + 1, k + 1 } };
        part = hullOf(part, here);
      }
    });
  if (part.isEmpty())
  {
    return {};
  }
  std::vector<double> values(volume(part.size()));
  this->Field.sample(lattice, part, values.data());
  samples.values.resize(samples.found.size());
  std::size_t from = 0;
  forCells(part.begin, part.size(),
    [&](int i, int j, int k) { samples.values[all.index(i, j, k)] = values[from++]; });
  return samples;
}

} // namespace filters
