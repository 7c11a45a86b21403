// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "BrickWorker.h"
#include "DataPiece.h"

#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>

namespace filters
{

/// By what pieces are known, also where one process has those of several ranks.
struct PieceName
{
  std::uint64_t number = 0; ///< of the data, see newNumberOfPieces()
  std::uint64_t rank = 0;
};
inline bool operator<(const PieceName& a, const PieceName& b)
{
  return std::tie(a.number, a.rank) < std::tie(b.number, b.rank);
}

/// What a rank has made of its piece of the data, and what makes bricks of it. Several PieceWorkers of a process may hold it.
struct HeldPiece
{
  explicit HeldPiece(std::shared_ptr<KeptOfMesh> kept, const PieceName& ofData = {})
    : name(ofData)
    , bricks(std::move(kept))
  {
  }

  const PieceName name;
  std::unique_ptr<const DataPiece> piece;
  BrickWorker bricks;
};

/// Pieces that are held in this process can be found by their names.
void addPiece(const std::shared_ptr<HeldPiece>& piece);
std::shared_ptr<HeldPiece> findPiece(const PieceName& name); // null: there is none

} // namespace filters
