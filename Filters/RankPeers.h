// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RankOutbox.h"

#include "vtkMultiProcessController.h"

#include "Rays/Channel.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace filters
{

namespace ranks
{

/// Messages between ranks by MPI, from and to any of them, with a tag of their own. Addresses are ranks.
class RankPeers : public schlieren::Peers
{
public:
  RankPeers(Communicator* communicator, int tag)
    : Of(communicator)
    , Tag(tag)
  {
  }

  void send(std::int32_t address, std::vector<char> message) override
  {
    this->Outgoing.HasUnsent();
    this->Outgoing.Send(std::move(message), address, this->Tag);
  }

  std::vector<char> receive() override
  {
    std::vector<char> message;
    this->Outgoing.HasUnsent();
#if VTK_MODULE_ENABLE_VTK_ParallelMPI // else there are no other ranks
    int has = 0, from = 0, size = 0;
    const char* type = nullptr; // says that it counts bytes
    this->Of->Iprobe(vtkMultiProcessController::ANY_SOURCE, this->Tag, &has, &from, type, &size);
    if (has != 0)
    {
      message.resize(static_cast<std::size_t>(size));
      this->Of->Receive(message.data(), size, from, this->Tag);
    }
#endif
    return message;
  }

private:
  Communicator* Of;
  int Tag;
  Outbox Outgoing{ this->Of };
};

} // namespace ranks

} // namespace filters
