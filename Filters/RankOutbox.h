// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkCommunicator.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPICommunicator.h"
#endif

#include <algorithm>
#include <cstddef>
#include <list>
#include <utility>
#include <vector>

namespace filters
{

namespace ranks
{

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
using Communicator = vtkMPICommunicator;
#else
using Communicator = vtkCommunicator; // there are no other ranks
#endif

/// Calls visit(first, count) for the pieces of a message: MPI counts by integers.
template <class Visit>
void forPieces(std::size_t size, const Visit& visit)
{
  constexpr std::size_t largest = std::size_t{ 1 } << 30;
  for (std::size_t first = 0; first < size; first += largest)
  {
    visit(first, static_cast<int>(std::min(largest, size - first)));
  }
}

/// Bytes on their way to other ranks. MPI's own way to send may wait until the other process receives, however little it is.
class Outbox
{
public:
  explicit Outbox(Communicator* communicator)
    : Of(communicator)
  {
  }

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
  /// Returns at once.
  void Send(std::vector<char> bytes, int rank, int tag)
  {
    this->Unsent.push_back({ std::move(bytes), {} });
    Message& last = this->Unsent.back();
    forPieces(last.bytes.size(),
      [&](std::size_t first, int count)
      {
        last.requests.emplace_back();
        this->Of->NoBlockSend(static_cast<const char*>(last.bytes.data()) + first, count, rank, tag,
          last.requests.back());
      });
  }

  /// Whether some of it has not been sent yet. Frees what has been.
  bool HasUnsent()
  {
    const auto isSent = [](vtkMPICommunicator::Request& request) { return request.Test() != 0; };
    while (!this->Unsent.empty())
    {
      std::vector<vtkMPICommunicator::Request>& requests = this->Unsent.front().requests;
      while (!requests.empty() && isSent(requests.back()))
      {
        requests.pop_back();
      }
      if (!requests.empty())
      {
        return true;
      }
      this->Unsent.pop_front();
    }
    return false;
  }

private:
  struct Message
  {
    std::vector<char> bytes;
    std::vector<vtkMPICommunicator::Request> requests;
  };
  std::list<Message> Unsent; // which MPI reads
#else                        // there are no other ranks
  void Send(std::vector<char>, int, int) {}
  bool HasUnsent() { return false; }

private:
#endif
  Communicator* Of;
};

} // namespace ranks

} // namespace filters
