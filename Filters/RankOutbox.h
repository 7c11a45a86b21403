// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bytes from rank to rank, by VTK's DIY.
#pragma once

#include "vtk_diy2.h"

#include <stdexcept> // which some versions of DIY lack
// clang-format off
#include VTK_DIY2(diy/mpi.hpp)
// clang-format on

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <list>
#include <utility>
#include <vector>

namespace filters
{

namespace ranks
{

using Communicator = diy::mpi::communicator;

/// MPI counts by integers: what is longer goes in several pieces, all but the last of this length.
inline constexpr std::int64_t longestPiece = std::int64_t{ 1 } << 30;

/// Bytes on their way to other ranks. MPI's own way to send may wait until the other process receives, however little it is.
class Outbox
{
public:
  explicit Outbox(Communicator communicator)
    : Of(std::move(communicator))
  {
  }

  /// Returns at once.
  void Send(std::vector<char> bytes, int rank, int tag)
  {
    const auto size = static_cast<std::int64_t>(bytes.size());
    if (size <= longestPiece)
    {
      this->SendPiece(std::move(bytes), rank, tag);
      return;
    }
    for (std::int64_t first = 0; first < size; first += longestPiece)
    {
      const auto last = bytes.begin() + std::min(first + longestPiece, size);
      this->SendPiece({ bytes.begin() + first, last }, rank, tag);
    }
  }

  /// How many pieces have not been sent yet. Frees those that have been.
  std::size_t CountUnsent()
  {
    while (!this->Unsent.empty() && this->Unsent.front().request.test())
    {
      this->Unsent.pop_front();
    }
    return this->Unsent.size();
  }

private:
  void SendPiece(std::vector<char> bytes, int rank, int tag)
  {
    Piece& piece = this->Unsent.emplace_back();
    piece.bytes = std::move(bytes);
    piece.request = this->Of.isend(rank, tag, piece.bytes);
  }

  struct Piece
  {
    std::vector<char> bytes; // which MPI reads
    diy::mpi::request request{};
  };
  Communicator Of;
  std::list<Piece> Unsent;
};

/// Waits for what an Outbox sends: so many bytes.
inline std::vector<char> receive(
  const Communicator& communicator, int rank, int tag, std::int64_t size)
{
  std::vector<char> bytes;
  bytes.reserve(static_cast<std::size_t>(size));
  communicator.recv(rank, tag, bytes);
  while (static_cast<std::int64_t>(bytes.size()) < size)
  {
    std::vector<char> piece;
    communicator.recv(rank, tag, piece);
    bytes.insert(bytes.end(), piece.begin(), piece.end());
  }
  return bytes;
}

} // namespace ranks

} // namespace filters
