// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "GasBoundary.h"
#include "LatticesOfMesh.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

namespace filters
{

struct PieceMesh;

/// What a rank keeps of the mesh of its last piece, for the piece of the next time step.
class KeptOfMesh
{
public:
  /// What bricks need. `number`: of the mesh on all ranks; 0: nothing is kept.
  struct OfBricks
  {
    std::uint64_t number = 0;
    std::shared_ptr<const GasBoundary> boundary;
    std::shared_ptr<LatticesOfMesh> lattices; // from the second step on the same mesh on
  };

  std::shared_ptr<PieceMesh> takePiece()
  {
    const std::lock_guard<std::mutex> lock(this->One);
    return std::exchange(this->Piece, nullptr);
  }
  void keep(std::shared_ptr<PieceMesh> piece)
  {
    const std::lock_guard<std::mutex> lock(this->One);
    this->Piece = std::move(piece);
  }

  OfBricks bricks() const
  {
    const std::lock_guard<std::mutex> lock(this->One);
    return this->Bricks;
  }
  void keep(const OfBricks& bricks)
  {
    const std::lock_guard<std::mutex> lock(this->One);
    this->Bricks = bricks;
  }

  void release()
  {
    this->keep(nullptr);
    this->keep(OfBricks{});
  }

private:
  mutable std::mutex One;
  std::shared_ptr<PieceMesh> Piece;
  OfBricks Bricks;
};

} // namespace filters
