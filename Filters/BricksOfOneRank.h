// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "BricksOfRanks.h"

#include <functional>
#include <memory>
#include <vector>

namespace filters
{

/// Of data that rank 0 has all of: it samples lattices, and others make bricks of that, to the last bit those that it would make.
class BricksOfOneRank : public BricksOfRanks
{
public:
  /// What rank 0 has on a lattice; called from several threads.
  using Sampler = std::function<DataPiece::Samples(const schlieren::Lattice& lattice)>;
  /// `mesh`: see BricksOfRanks. `source`: must outlive this.
  BricksOfOneRank(std::shared_ptr<PieceRanks> ranks, std::uint64_t mesh,
    const schlieren::MediumSource& source, std::shared_ptr<const GasBoundary> boundary,
    Sampler sampler);

  /// False, too, once a rank could not.
  bool mayHelp() const { return !this->HasFailed && this->Ranks->MayHelp(); }
  std::vector<std::vector<char>> make(const schlieren::BrickRules& rules, const Tasks& tasks,
    const MakeHere& makeHere) const override;

private:
  const SamplesOfPieces& known() const override { return this->Known; }
  std::vector<std::size_t> deal(const Tasks& tasks) const override;
  std::vector<Contribution> contributions(
    const Tasks& tasks, const std::vector<std::size_t>& makers) const override;

  const schlieren::MediumSource& Source;
  SamplesOfPieces Known;
  Sampler SamplesOn;
  mutable bool HasFailed = false;
};

} // namespace filters
