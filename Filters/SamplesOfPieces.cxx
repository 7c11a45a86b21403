// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SamplesOfPieces.h"

#include <algorithm>
#include <limits>

namespace filters
{

SamplesOfPieces::BoxKey SamplesOfPieces::keyOf(const schlieren::Box& box)
{
  return { box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2] };
}

SamplesOfPieces::LatticeKey SamplesOfPieces::keyOf(const schlieren::Lattice& lattice)
{
  const auto& [first, spacing, points] = lattice;
  return { first[0], first[1], first[2], spacing[0], spacing[1], spacing[2],
    static_cast<double>(points[0]), static_cast<double>(points[1]),
    static_cast<double>(points[2]) };
}

schlieren::MediumSource::Content SamplesOfPieces::contentOf(const schlieren::Box& box) const
{
  const bool isAll = box.low == this->All.bounds.low && box.high == this->All.bounds.high;
  return isAll ? this->All.content : this->box(box).content;
}

const DataPiece::Samples& SamplesOfPieces::at(const schlieren::Lattice& lattice) const
{
  const auto found = this->Samples.find(keyOf(lattice));
  if (found == this->Samples.end())
  {
    throw NotSampled();
  }
  return found->second;
}

void SamplesOfPieces::sample(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances) const
{
  const DataPiece::Samples& samples = this->at(lattice);
  const auto size = static_cast<std::size_t>(lattice.size());
  std::fill_n(refractivity, size, 0.);
  std::copy(samples.values.begin(), samples.values.end(), refractivity);
  if (const auto known = this->Lattices ? this->Lattices->find(lattice, distances) : nullptr)
  {
    known->copyTo(places, distances, size);
    return;
  }
  const std::vector<unsigned char> none(samples.found.empty() ? size : 0, 0);
  this->Boundary->sample(
    lattice, none.empty() ? samples.found.data() : none.data(), places, distances);
  if (this->Lattices && this->Lattices->hasRoomFor(lattice))
  {
    this->Lattices->keep(lattice, knownLattice({}, places, distances, size));
  }
}

schlieren::MediumSource::FieldRange SamplesOfPieces::rangeOfField(
  int field, const schlieren::Box& box) const
{
  const auto number = static_cast<std::size_t>(field);
  const auto found = this->Boxes.find(keyOf(box));
  return found == this->Boxes.end() ? this->RangesOfFields[number] : found->second.fields[number];
}

void SamplesOfPieces::sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
  schlieren::Place* places, float* distances, double* values) const
{
  this->sample(lattice, refractivity, places, distances);
  const std::vector<double>& fields = this->at(lattice).fields;
  std::fill_n(values, static_cast<std::size_t>(lattice.size()) * this->RangesOfFields.size(),
    std::numeric_limits<double>::quiet_NaN());
  std::copy(fields.begin(), fields.end(), values);
}

} // namespace filters
