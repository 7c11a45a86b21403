// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Ranks/PieceSamples.h"
#include "Ranks/Ranks.h"
#include "Sources/PieceSource.h"

#include "Schlieren.h"

#include <array>
#include <cstdint>
#include <limits>
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
class SamplesOverRanks : public PieceSource, public schlieren::BrickMakers
{
public:
  /// `number`: identifies the source on all ranks. `facts`: of all data. For the others see PieceSource.
  SamplesOverRanks(const Ranks& ranks, std::uint64_t number, std::unique_ptr<const DataPiece> piece,
    const DataPiece::Facts& facts, std::shared_ptr<const GasBoundary> boundary, double ambient,
    std::shared_ptr<LatticeCache> lattices, int threads);

  /// The first bytes of a request for bricks, which other ranks answer by answerBricks().
  static constexpr std::uint32_t requestOfBricks = 20;
  std::uint64_t number() const { return this->Number; }
  /// Sets, on rank 0, the ranks that make bricks; null: none.
  void use(FilterRanks* ranks) const { this->Used = ranks; }
  bool isUsedBy(const FilterRanks* ranks) const { return this->Used == ranks; }
  /// Answers a request, from behind its first bytes and number.
  std::vector<char> answerBricks(Reader& request) const;

  Content contentOf(const schlieren::Box& box) const override;
  bool dependsOnLattice() const override { return true; }

  const schlieren::BrickMakers* makers() const override { return this; }
  void prepareContents(const std::vector<schlieren::Box>& boxes) const override;
  void prepareSamples(const std::vector<schlieren::Lattice>& lattices) const override;

  int count() const override { return static_cast<int>(this->AllRanks.count()); }
  std::vector<std::vector<char>> make(const schlieren::BrickRules& rules,
    const std::vector<schlieren::BrickRequest>& requests) const override;

protected:
  void sampleGas(const schlieren::Lattice& lattice, double* refractivity, unsigned char* found,
    CellsOfLattice* cells) const override;
  bool sampleGasIn(const CellsOfLattice& cells, const schlieren::Lattice& lattice,
    double* refractivity) const override;

private:
  /// Content of a rank in a box: its cells, and which of GasBoundary::testedPlaces() they contain.
  struct OwnContent
  {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    CellTree::Content cells{ 1, 0, { infinity, infinity, infinity } };
    std::array<unsigned char, 9> holds{};

    void add(const OwnContent& other);
  };
  using BoxKey = std::array<double, 6>;
  using LatticeKey = std::array<double, 9>;
  static BoxKey keyOf(const schlieren::Box& box);
  static LatticeKey keyOf(const schlieren::Lattice& lattice);
  Content contentWith(const schlieren::Box& box, const OwnContent& found) const;
  OwnContent ownContentOf(const schlieren::Box& box) const;
  std::vector<char> ownContentsOf(const std::vector<schlieren::Box>& boxes) const;
  std::vector<std::vector<char>> ownSamplesOn(
    const std::vector<schlieren::Lattice>& lattices) const;
  std::vector<std::vector<char>> makeShare(
    const schlieren::BrickRules& rules, const std::vector<schlieren::BrickRequest>& requests) const;

  const Ranks AllRanks;
  const std::uint64_t Number;
  const DataPiece::Facts Own; // of its piece
  const int Threads;
  const Content Whole; // of bounds()
  mutable std::map<BoxKey, Content> Boxes;
  mutable std::map<LatticeKey, PieceSamples> Samples;
  mutable FilterRanks* Used = nullptr;
};

/// Extend the bounds or content of a piece by those of another one.
void extend(schlieren::Box& box, const schlieren::Box& by);
void extend(CellTree::Content& content, const CellTree::Content& by);

} // namespace filters
