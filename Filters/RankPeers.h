// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RankOutbox.h"

#include "Rays/Channel.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace filters
{

namespace ranks
{

/// Messages between ranks, from and to any of them, with a tag of their own. Addresses are ranks. DIY's iexchange, which
/// does the same for blocks, ends when all ranks agree that there is nothing left: one that has failed could not leave it,
/// and rank 0 could not abort.
class RankPeers : public schlieren::Peers
{
public:
  RankPeers(const Communicator& communicator, int tag)
    : Of(communicator)
    , Tag(tag)
  {
  }

  void send(std::int32_t address, std::vector<char> message) override
  {
    this->Outgoing.CountUnsent();
    this->Outgoing.Send(std::move(message), address, this->Tag);
  }

  std::vector<char> receive() override
  {
    std::vector<char> message;
    this->Outgoing.CountUnsent();
    if (auto status = this->Of.iprobe(diy::mpi::any_source, this->Tag))
    {
      this->Of.recv(status->source(), this->Tag, message);
    }
    return message;
  }

private:
  Communicator Of;
  int Tag;
  Outbox Outgoing{ this->Of };
};

} // namespace ranks

} // namespace filters
