// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "KeptOfMesh.h"
#include "SamplesOfPieces.h"

#include "Medium/BrickMakers.h"

#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace filters
{

class Reader;

/// A brick that a BrickWorker makes, as it is sent. Behind it come the ranges of fields in its box, and what others than its
/// maker have on its lattice, in the order of their ranks.
struct TaskOfPieces
{
  schlieren::BrickTask task;
  std::uint32_t others;       ///< how many have something
  std::uint32_t othersBefore; ///< of lower rank than its maker
  std::uint32_t hasOwn;       ///< its maker has something, too
};

/// Makes bricks on a rank, for BricksOfRanks on rank 0: of what it has of the data and of what others have.
class BrickWorker
{
public:
  explicit BrickWorker(std::shared_ptr<KeptOfMesh> kept)
    : Kept(std::move(kept))
  {
  }

  /// `number`: of the data. The request: which mesh they are on, rules, facts about all of the data, ranges of fields, and where
  /// the gas ends.
  void begin(std::uint64_t number, Reader& request);
  /// The request: the tasks. The answer: the bricks; empty where more samples are needed. `own`: null where the rank has no data.
  void make(std::uint64_t number, Reader& request, const DataPiece* own, int threads,
    std::vector<char>& answer);

private:
  template <class Real>
  void makeOf(const std::vector<TaskOfPieces>& tasks,
    const std::vector<std::vector<std::vector<char>>>& ofOthers, const DataPiece* own, int threads,
    std::vector<char>& answer);
  template <class Real>
  using Maker = std::unique_ptr<const schlieren::BrickMaker<Real>>;

  std::shared_ptr<KeptOfMesh> Kept;
  std::uint64_t Number = 0;
  std::unique_ptr<SamplesOfPieces> Known;
  std::tuple<Maker<float>, Maker<double>> Makers; // one of them
};

} // namespace filters
