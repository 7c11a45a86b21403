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

/// Deals the bricks of data that are spread over several ranks out to these, on rank 0: each to a rank that has much of the data
/// there, as long as none has much more work than others. What others have of it, rank 0 passes on. See BrickWorker.
class BricksOfPieces : public schlieren::BrickMakers
{
public:
  /// Of the ranks' pieces: their number, and where each has cells. `mesh`: a number that two of these have in common only if
  /// nothing but values differs; 0: it is not known. `known`: must outlive this, and knows the boxes of what is made.
  BricksOfPieces(std::shared_ptr<PieceRanks> ranks, std::uint64_t number,
    std::vector<schlieren::Box> boundsOfRanks, std::uint64_t mesh, const SamplesOfPieces& known)
    : Ranks(std::move(ranks))
    , Number(number)
    , BoundsOfRanks(std::move(boundsOfRanks))
    , Mesh(mesh)
    , Known(known)
  {
  }

  std::int32_t count() const override { return static_cast<std::int32_t>(this->Ranks->Count()); }
  std::vector<std::vector<char>> make(const schlieren::BrickRules& rules,
    const std::vector<schlieren::BrickTask>& tasks) const override;

private:
  using Messages =
    std::vector<std::vector<char>>; // of the ranks, or of those with samples of a lattice

  void begin(const schlieren::BrickRules& rules) const;
  std::vector<std::size_t> deal(const std::vector<schlieren::BrickTask>& tasks) const;
  std::vector<Messages> samplesOfOthers(
    const std::vector<schlieren::BrickTask>& tasks, const std::vector<std::size_t>& makers) const;
  bool mayHave(std::size_t rank, const schlieren::BrickTask& task) const;

  std::shared_ptr<PieceRanks> Ranks;
  std::uint64_t Number;
  std::vector<schlieren::Box> BoundsOfRanks;
  std::uint64_t Mesh;
  const SamplesOfPieces& Known;
  mutable std::vector<char> Begun; // the rules
};

} // namespace filters
