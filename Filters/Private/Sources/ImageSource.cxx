// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/ImageSource.h"

#include "Common/FieldFromImage.h"

#include "vtkImageData.h"

#include <limits>

namespace filters
{

ImageSource::ImageSource(
  vtkImageData* refractivity, vtkDataObject* bodies, int threads, const WorkProgress& progress)
  : Bodies(turnedBack(bodies, gridFrom(refractivity).direction))
  , Piece(refractivity, this->Bodies, threads)
  , Ambient(this->Piece.ambient())
{
  progress.reach(0.8);
  this->Boundary =
    std::make_shared<const GasBoundary>(this->Piece.faces(), this->Bodies, Outside::Passes);
  this->Bodies = nullptr;
}

schlieren::MediumSource::Content ImageSource::contentOf(const schlieren::Box& box) const
{
  Content content{ 1, 0, {}, false, true, false };
  content.cellSize.fill(std::numeric_limits<double>::infinity());
  this->Boundary->findPlaces(
    box, [this](const Point& place) { return this->Piece.isGasAt(place); }, content);
  if (content.hasGas)
  {
    const CellTree::Content found = this->Piece.contentOf(box);
    content.lowest = found.lowest;
    content.highest = found.highest;
    content.cellSize = found.cellSize;
  }
  return content;
}

void ImageSource::sample(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances) const
{
  std::vector<unsigned char> hasGas(static_cast<std::size_t>(lattice.size()));
  this->Piece.sample(0, lattice, refractivity, hasGas.data());
  this->Boundary->sample(lattice, hasGas.data(), places, distances);
}

schlieren::MediumSource::FieldRange ImageSource::rangeOfField(
  int field, const schlieren::Box& box) const
{
  return this->Piece.rangeOfField(field, box);
}

void ImageSource::sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances, double* values) const
{
  this->sample(lattice, refractivity, places, distances);
  const auto size = static_cast<std::size_t>(lattice.size());
  for (int field = 1; field <= this->Piece.fields(); ++field)
  {
    this->Piece.sample(static_cast<std::size_t>(field), lattice, values, nullptr);
    for (std::size_t point = 0; point < size; ++point)
    {
      values[point] = places[point] == schlieren::Place::Gas
        ? values[point]
        : std::numeric_limits<double>::quiet_NaN();
    }
    values += size;
  }
}

} // namespace filters
