// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "BricksOfRanks.h"

#include <vector>

namespace filters
{

/// Of data that are spread over several ranks: each brick is made by a rank that has much of the data there, as long as none has
/// much more work than others. What others have of it, rank 0 passes on.
class BricksOfPieces : public BricksOfRanks
{
public:
  /// `boundsOfRanks`: where each has cells. `known`: must outlive this, and knows the boxes of what is made.
  BricksOfPieces(std::shared_ptr<PieceRanks> ranks, std::uint64_t number, std::uint64_t mesh,
    std::vector<schlieren::Box> boundsOfRanks, const SamplesOfPieces& known)
    : BricksOfRanks(std::move(ranks), number, mesh, true)
    , BoundsOfRanks(std::move(boundsOfRanks))
    , Known(known)
  {
  }

private:
  const SamplesOfPieces& known() const override { return this->Known; }
  std::vector<std::size_t> deal(const Tasks& tasks) const override;
  std::vector<Contribution> contributions(
    const Tasks& tasks, const std::vector<std::size_t>& makers) const override;
  bool mayHave(std::size_t rank, const schlieren::BrickTask& task) const;

  std::vector<schlieren::Box> BoundsOfRanks;
  const SamplesOfPieces& Known;
};

} // namespace filters
