// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "BricksOfOneRank.h"
#include "SourceOfRanks.h"

#include "Medium/MediumSource.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace filters
{

/// A source that rank 0 has all of, of whose samples other ranks may make bricks.
class HelpedSource : public schlieren::MediumSource, public SourceOfRanks
{
public:
  /// From now on those that may help do.
  void setHelpers(std::shared_ptr<PieceRanks> ranks)
  {
    const std::shared_ptr<const GasBoundary> boundary = this->sharedBoundary();
    if (ranks->Count() > 1 && !this->isFlat() && boundary->surface().size() <= mostSharedFaces)
    {
      this->Helpers = std::make_unique<BricksOfOneRank>(std::move(ranks), this->meshNumber(), *this,
        boundary, [this](const schlieren::Lattice& lattice) { return this->samplesOn(lattice); });
    }
  }
  bool useRanks(const std::shared_ptr<PieceRanks>& ranks) const override
  {
    if (this->Helpers)
    {
      this->Helpers->useRanks(ranks);
    }
    return true;
  }
  bool usesRanks(const PieceRanks& ranks) const override
  {
    return !this->Helpers || this->Helpers->usesRanks(ranks);
  }

  const schlieren::BrickMakers* makers() const override
  {
    return this->Helpers && this->Helpers->mayHelp() ? this->Helpers.get() : nullptr;
  }

private:
  /// Where the gas ends.
  virtual std::shared_ptr<const GasBoundary> sharedBoundary() const = 0;
  /// What sample() has before it knows that, and the fields.
  virtual DataPiece::Samples samplesOn(const schlieren::Lattice& lattice) const = 0;
  /// See BricksOfRanks.
  virtual std::uint64_t meshNumber() const { return 0; }

  std::unique_ptr<const BricksOfOneRank> Helpers; // may be null
};

} // namespace filters
