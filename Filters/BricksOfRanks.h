// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PieceRanks.h"
#include "SamplesOfPieces.h"

#include "Medium/BrickMakers.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace filters
{

/// Triangles of a boundary that all ranks get; some 200 bytes each.
constexpr std::size_t mostSharedFaces = 2000000;

/// For data that ranks have pieces of: no two have the same.
std::uint64_t newNumberOfPieces();

/// Deals bricks out to the ranks, on rank 0. See BrickWorker, which makes them.
class BricksOfRanks : public schlieren::BrickMakers
{
public:
  /// `number`: of the data. `mesh`: a number that two have in common only if nothing but values differs; 0: it is not known.
  /// `arePieces`: the ranks have pieces of the data with this number.
  BricksOfRanks(
    std::shared_ptr<PieceRanks> ranks, std::uint64_t number, std::uint64_t mesh, bool arePieces)
    : Ranks(std::move(ranks))
    , Number(number)
    , Mesh(mesh)
    , ArePieces(arePieces)
  {
  }

  std::int32_t count() const override { return static_cast<std::int32_t>(this->Ranks->Count()); }
  std::vector<std::vector<char>> make(const schlieren::BrickRules& rules,
    const std::vector<schlieren::BrickTask>& tasks, const MakeHere& makeHere) const override;

  /// See SourceOfRanks.
  void useRanks(const std::shared_ptr<PieceRanks>& ranks) const
  {
    this->Ranks = ranks;
    if (!this->ArePieces) // which have what they need to begin
    {
      this->Begun.clear();
    }
  }
  bool usesRanks(const PieceRanks& ranks) const { return this->Ranks.get() == &ranks; }

protected:
  using Tasks = std::vector<schlieren::BrickTask>;
  using Messages =
    std::vector<std::vector<char>>; // of the ranks, or of those with samples of a lattice

  /// Of all of the data; it need not know any box.
  virtual const SamplesOfPieces& known() const = 0;
  /// Who makes each.
  virtual std::vector<std::size_t> deal(const Tasks& tasks) const = 0;
  /// Of a brick: the ranges of fields in its box, what others than its maker have, and whether it has something itself.
  struct Contribution
  {
    std::vector<schlieren::MediumSource::FieldRange> fields;
    Messages ofOthers{};    // DataPiece::Samples::Put(), in the order of the ranks
    std::size_t before = 0; // of lower rank than the maker
    bool hasOwn = false;
  };
  virtual std::vector<Contribution> contributions(
    const Tasks& tasks, const std::vector<std::size_t>& makers) const = 0;
  /// Adds each cost to the work of one of the ranks: where it may be, of `preferred`; else of who has least to do.
  static std::vector<std::size_t> balanced(std::vector<double> work,
    const std::vector<double>& costs, const std::vector<std::size_t>& preferred);
  static double costOf(const schlieren::BrickTask& task);

  mutable std::shared_ptr<PieceRanks> Ranks;
  std::uint64_t Number;

private:
  void begin(const schlieren::BrickRules& rules) const;

  std::uint64_t Mesh;
  bool ArePieces;
  mutable std::vector<char> Begun; // the rules
};

} // namespace filters
