// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "AmrPiece.h"

#include "DataParts.h"

#include <cstddef>
#include <limits>

namespace filters
{

DataPiece::Summary AmrPiece::summary() const
{
  return { this->Fields[0].ownCells(), this->Fields[0].ownBounds(),
    this->Fields[0].contentOf(this->Fields[0].bounds()), this->Fields[0].reachOfContent() };
}

void AmrPiece::putBoundary(std::int64_t, std::vector<char>& message) const
{
  const BoundaryFaces faces = this->Fields[0].faces();
  put(BoundaryKind::OfAmr, message);
  putAll(faces.surface.points, message);
  putAll(faces.surface.corners, message);
  putAll(faces.hidesBehind, message);
  putAll(this->Fields[0].outerValues(), message);
}

schlieren::MediumSource::FieldRange AmrPiece::rangeOfField(
  int field, const schlieren::Box& box) const
{
  const CellTree::Content content =
    this->Fields[static_cast<std::size_t>(field) + 1].contentOf(box);
  return { content.lowest, content.highest };
}

DataPiece::Samples AmrPiece::sample(const schlieren::Lattice& lattice) const
{
  if (!this->Fields[0].mayHold(lattice))
  {
    return {};
  }
  Samples samples{ this->Fields[0].gasAt(lattice), {} };
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
  const auto sampleTo = [&](const AmrField& field, double* to)
  {
    field.sample(lattice, part, values.data());
    std::size_t from = 0;
    forCells(part.begin, part.size(),
      [&](int i, int j, int k) { to[all.index(i, j, k)] = values[from++]; });
  };
  const std::size_t size = samples.found.size();
  samples.values.resize(size);
  sampleTo(this->Fields[0], samples.values.data());
  samples.fields.resize((this->Fields.size() - 1) * size, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t number = 1; number < this->Fields.size(); ++number)
  {
    double* const to = samples.fields.data() + (number - 1) * size;
    sampleTo(this->Fields[number], to);
    const std::vector<unsigned char> isKnown = this->Fields[number].gasAt(lattice);
    for (std::size_t i = 0; i < size; ++i)
    {
      to[i] = isKnown[i] ? to[i] : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return samples;
}

} // namespace filters
