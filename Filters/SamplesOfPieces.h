// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DataPiece.h"
#include "GasBoundary.h"
#include "LatticesOfMesh.h"

#include "Medium/MediumSource.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

namespace filters
{

/// A lattice was not sampled.
struct NotSampled : std::runtime_error
{
  NotSampled()
    : std::runtime_error("A rank has not the samples that it needs. Update the filter again.")
  {
  }
};

/// What ranks have said of data that they have: of boxes and of lattices. It knows nothing of others: std::out_of_range or
/// NotSampled. Its const functions may be called from several threads.
class SamplesOfPieces : public schlieren::MediumSource
{
public:
  /// Of all of the data.
  struct Facts
  {
    schlieren::Box bounds{};
    double ambient = 0;
    std::array<double, 3> voxelShape{ 1, 1, 1 };
    std::array<double, 9> direction{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    Content content{};
    bool dependsOnLattice = true; ///< see MediumSource; likewise where no rank has all of the data
  };
  /// `lattices`: what is known of them from earlier time steps; may be null.
  SamplesOfPieces(const Facts& facts, std::vector<FieldRange> rangesOfFields,
    std::shared_ptr<const GasBoundary> boundary, std::shared_ptr<LatticesOfMesh> lattices = {})
    : All(facts)
    , RangesOfFields(std::move(rangesOfFields))
    , Boundary(std::move(boundary))
    , Lattices(std::move(lattices))
  {
  }

  const Facts& facts() const { return this->All; }
  const std::vector<FieldRange>& rangesOfFields() const { return this->RangesOfFields; }
  const GasBoundary& boundary() const { return *this->Boundary; }

  struct KnownBox
  {
    Content content;
    std::vector<FieldRange> fields;
    std::vector<unsigned char> shares{}; ///< about how much of it each rank has; 0: perhaps nothing
  };
  void forgetBoxes() { this->Boxes.clear(); }
  KnownBox& box(const schlieren::Box& box) { return this->Boxes[keyOf(box)]; }
  const KnownBox& box(const schlieren::Box& box) const { return this->Boxes.at(keyOf(box)); }

  void forgetLattices() { this->Samples.clear(); }
  DataPiece::Samples& samples(const schlieren::Lattice& lattice)
  {
    return this->Samples[keyOf(lattice)];
  }

  schlieren::Box bounds() const override { return this->All.bounds; }
  double ambient() const override { return this->All.ambient; }
  std::array<double, 3> voxelShape() const override { return this->All.voxelShape; }
  std::array<double, 9> direction() const override { return this->All.direction; }
  Content contentOf(const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override;

  int fields() const override { return static_cast<int>(this->RangesOfFields.size()); }
  /// Of a box that it does not know, that of all data.
  FieldRange rangeOfField(int field, const schlieren::Box& box) const override;
  void sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
    schlieren::Place* places, float* distances, double* values) const override;

  bool dependsOnLattice() const override { return this->All.dependsOnLattice; }

private:
  using BoxKey = std::array<double, 6>;
  using LatticeKey = std::array<double, 9>;
  static BoxKey keyOf(const schlieren::Box& box);
  static LatticeKey keyOf(const schlieren::Lattice& lattice);

  Facts All;
  std::vector<FieldRange> RangesOfFields;
  std::shared_ptr<const GasBoundary> Boundary;
  std::shared_ptr<LatticesOfMesh> Lattices;
  std::map<BoxKey, KnownBox> Boxes;
  std::map<LatticeKey, DataPiece::Samples> Samples;
  const DataPiece::Samples& at(const schlieren::Lattice& lattice) const;
};

} // namespace filters
