// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/AmrSource.h"

#include <limits>

namespace filters
{

namespace
{

BoundaryFaces facesOf(const AmrField& field)
{
  BoundaryFaces faces = field.faces();
  sortTriangles(faces);
  return faces;
}

} // namespace

AmrSource::AmrSource(const AmrLevels& levels, const Source& source, vtkDataObject* bodies,
  Outside outside, Tally& tally, const WorkProgress& progress)
  : Refractivity(levels, source, tally, progress.part(0, 0.9))
  , Boundary(std::make_shared<const GasBoundary>(facesOf(this->Refractivity), bodies, outside))
{
  progress.reach(1);
}

schlieren::MediumSource::Content AmrSource::contentOf(const schlieren::Box& box) const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Content content{ infinity, -infinity, { infinity, infinity, infinity }, false, true, false };
  this->Boundary->findPlaces(
    box, [this](const Point& place) { return this->Refractivity.hasGasAt(place); }, content);
  if (content.hasGas)
  {
    const CellTree::Content cells = this->Refractivity.contentOf(box);
    content.lowest = cells.lowest;
    content.highest = cells.highest;
    content.cellSize = cells.cellSize;
  }
  return content;
}

void AmrSource::sample(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances) const
{
  this->Refractivity.sample(lattice, { { 0, 0, 0 }, lattice.points }, refractivity);
  const std::vector<unsigned char> hasGas = this->Refractivity.gasAt(lattice);
  this->Boundary->sample(lattice, hasGas.data(), places, distances);
}

void AmrSource::addField(const AmrLevels& levels, const Source& source)
{
  Tally notReported;
  this->Fields.push_back(std::make_unique<const AmrField>(levels, source, notReported));
}

schlieren::MediumSource::FieldRange AmrSource::rangeOfField(
  int field, const schlieren::Box& box) const
{
  const CellTree::Content content = this->Fields[static_cast<std::size_t>(field)]->contentOf(box);
  return { content.lowest, content.highest };
}

void AmrSource::sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances, double* values) const
{
  this->sample(lattice, refractivity, places, distances);
  this->sampleFields(lattice, values);
}

void AmrSource::sampleFields(const schlieren::Lattice& lattice, double* values) const
{
  const auto size = static_cast<std::size_t>(lattice.size());
  for (const auto& field : this->Fields)
  {
    field->sample(lattice, { { 0, 0, 0 }, lattice.points }, values);
    const std::vector<unsigned char> isKnown = field->gasAt(lattice);
    for (std::size_t i = 0; i < size; ++i)
    {
      values[i] = isKnown[i] ? values[i] : std::numeric_limits<double>::quiet_NaN();
    }
    values += size;
  }
}

} // namespace filters
