// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Cells/LatticesOfMesh.h"
#include "Ranks/Ranks.h"
#include "Sources/DataPiece.h"
#include "Walls/GasBoundary.h"

#include "Schlieren.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace filters
{

/**
 * The refractivity of data in pieces on several ranks. Every rank has such a source, with the
 * boundary of all data. Contents of boxes are reduced over all ranks; samples are summed up by the
 * rank that makes the brick. Each rank samples its own cells, and the first rank decides for shared
 * points.
 *
 * Rank 0 has the tree, and requests bricks of the ranks of the filter that uses it, see use().
 */
class SamplesOverRanks : public schlieren::MediumSource, public schlieren::BrickMakers
{
public:
  /// Properties of the whole data.
  struct Facts
  {
    schlieren::Box bounds{};
    double ambient = 0;
    std::array<double, 3> voxelShape{ 1, 1, 1 };
    std::array<double, 9> direction{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    CellTree::Content content{};
    std::vector<FieldRange> fields{};
  };
  /// `number`: identifies the source on all ranks. `lattices`: of earlier time steps; may be null.
  SamplesOverRanks(const Ranks& ranks, std::uint64_t number, Facts facts,
    std::unique_ptr<const DataPiece> piece, std::shared_ptr<const GasBoundary> boundary,
    std::shared_ptr<LatticesOfMesh> lattices, int threads);

  /// The first bytes of a request for bricks, which other ranks answer by answerBricks().
  static constexpr std::uint32_t requestOfBricks = 20;
  std::uint64_t number() const { return this->Number; }
  /// Sets, on rank 0, the ranks that make bricks; null: none.
  void use(FilterRanks* ranks) const { this->Used = ranks; }
  bool isUsedBy(const FilterRanks* ranks) const { return this->Used == ranks; }
  /// Answers a request, from behind its first bytes and number.
  std::vector<char> answerBricks(Reader& request) const;

  schlieren::Box bounds() const override { return this->All.bounds; }
  double ambient() const override { return this->All.ambient; }
  std::array<double, 3> voxelShape() const override { return this->All.voxelShape; }
  std::array<double, 9> direction() const override { return this->All.direction; }
  Content contentOf(const schlieren::Box& box) const override;
  void sample(const schlieren::Lattice& lattice, double* refractivity, schlieren::Place* places,
    float* distances) const override;
  bool dependsOnLattice() const override { return true; }

  int fields() const override { return static_cast<int>(this->All.fields.size()); }
  /// Returns the range in a prepared box, or that of all data.
  FieldRange rangeOfField(int field, const schlieren::Box& box) const override;
  void sampleWithFields(const schlieren::Lattice& lattice, double* refractivity,
    schlieren::Place* places, float* distances, double* values) const override;

  const schlieren::BrickMakers* makers() const override { return this; }
  void prepareContents(const std::vector<schlieren::Box>& boxes) const override;
  void prepareSamples(const std::vector<schlieren::Lattice>& lattices) const override;

  int count() const override { return static_cast<int>(this->AllRanks.count()); }
  std::vector<std::vector<char>> make(const schlieren::BrickRules& rules,
    const std::vector<schlieren::BrickRequest>& requests) const override;

private:
  struct KnownBox
  {
    Content content;
    std::vector<FieldRange> fields;
  };
  /// Content of a rank in a box: its cells, and which of GasBoundary::testedPlaces() they contain.
  struct OwnContent
  {
    CellTree::Content cells;
    std::array<unsigned char, 9> holds;
  };
  using BoxKey = std::array<double, 6>;
  using LatticeKey = std::array<double, 9>;
  static BoxKey keyOf(const schlieren::Box& box);
  static LatticeKey keyOf(const schlieren::Lattice& lattice);
  const DataPiece::Samples& samplesOn(const schlieren::Lattice& lattice) const;
  Content contentFrom(const schlieren::Box& box, const OwnContent& found) const;
  OwnContent ownContentOf(const schlieren::Box& box) const;
  std::vector<std::vector<char>> makeShare(
    const schlieren::BrickRules& rules, const std::vector<schlieren::BrickRequest>& requests) const;

  const Ranks AllRanks;
  const std::uint64_t Number;
  const Facts All;
  const std::unique_ptr<const DataPiece> Piece;
  const std::shared_ptr<const GasBoundary> Boundary;
  const std::shared_ptr<LatticesOfMesh> Lattices;
  const int Threads;
  Content Whole; // of bounds()
  mutable std::map<BoxKey, KnownBox> Boxes;
  mutable std::map<LatticeKey, DataPiece::Samples> Samples;
  mutable FilterRanks* Used = nullptr;
};

/// Extend the bounds, content or range of a piece by those of another one.
void extend(schlieren::Box& box, const schlieren::Box& by);
void extend(CellTree::Content& content, const CellTree::Content& by);
void extend(
  schlieren::MediumSource::FieldRange& range, const schlieren::MediumSource::FieldRange& by);

} // namespace filters
