// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the ranks of a filter send each other to meet, and how.
#pragma once

#include "vtkMultiProcessController.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"
#endif

#include "Rays/Channel.h"
#include "Rays/RayWorker.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <deque>
#include <list>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace filters
{

namespace ranks
{

/// What a rank has of an input: numbers of points and cells, bounds.
using Holdings = std::array<double, 8>;

/// The first bytes of messages. Those of rays have other numbers.
enum Kind : std::uint32_t
{
  Hello = 1, // to rank 0
  Begin,     // to others: an answer to Hello
  Leave,     // to rank 0, which does not come
  GiveData,  // to others
  Data,      // to rank 0
  End,       // to others
  Ended      // to rank 0, an answer to End
};

struct HelloMessage
{
  std::uint32_t kind = Hello;
  std::int32_t meeting = 0; // of this rank
  double changes = 0;       // the version of the inputs
  double timeStep = 0;
  Holdings inputs[2] = {};
  std::int32_t areMeshes = 1; // the first of them
};
struct ShortMessage
{
  std::uint32_t kind = 0;
  // Begin: the meeting; GiveData: the input; Data: 1 with data, 0 with a text; End: the outcome
  std::int32_t number = 0;
};

template <class Head>
std::vector<char> messageOf(const Head& head, const std::vector<char>& behind = {})
{
  std::vector<char> message(sizeof(Head) + behind.size());
  std::memcpy(message.data(), &head, sizeof(Head));
  std::copy(behind.begin(), behind.end(), message.begin() + sizeof(Head));
  return message;
}

template <class Head>
Head read(const std::vector<char>& message)
{
  Head head;
  if (!message.empty())
  {
    std::memcpy(&head, message.data(), std::min(sizeof(Head), message.size()));
  }
  return head;
}

inline void waitABit() { std::this_thread::sleep_for(std::chrono::microseconds(100)); }

/// Messages by MPI.
class RankChannel : public schlieren::Channel
{
public:
  RankChannel(vtkMultiProcessController* controller, int rank, int tag)
    : Controller(controller)
    , Rank(rank)
    , Tag(tag)
  {
  }

  void send(std::vector<char> message) override
  {
    const auto size = static_cast<std::int64_t>(message.size());
    std::vector<char> head(sizeof(size));
    std::memcpy(head.data(), &size, sizeof(size));
    this->Begin(std::move(head));
    this->Begin(std::move(message));
    while (size > largestSmall && this->HasUnsent())
    {
      waitABit();
    }
  }
  bool hasMessage() override
  {
    this->Poll();
    return !this->Messages.empty();
  }
  std::vector<char> receive() override
  {
    while (!this->hasMessage())
    {
      waitABit();
    }
    std::vector<char> message = std::move(this->Messages.front());
    this->Messages.pop_front();
    return message;
  }
  /// The next one of a kind, and none before it; empty where the other rank leaves.
  std::vector<char> ReceiveOne(std::uint32_t kind)
  {
    while (this->isOpen())
    {
      std::vector<char> message;
      if (this->hasMessage())
      {
        message = this->receive();
      }
      else
      {
        waitABit();
      }
      if (read<ShortMessage>(message).kind == kind)
      {
        return message;
      }
    }
    return {};
  }
  bool isOpen() const override { return this->Guest.has_value(); }

  // On rank 0: of a rank that waits for it, and of one that is at the meeting.
  std::optional<HelloMessage> Greeting, Guest;

  /// Leaves the meeting, or a rank 0 that has not come.
  void Close()
  {
    this->Guest.reset();
    this->Messages.clear();
  }

  /// Takes what has arrived.
  void Poll()
  {
    this->HasUnsent();
    while (this->HasArrived())
    {
      std::int64_t size = 0;
      this->Receive(reinterpret_cast<char*>(&size), sizeof(size));
      std::vector<char> message(static_cast<std::size_t>(size));
      this->Receive(message.data(), message.size());
      switch (schlieren::RayWorker::kindOf(message))
      {
        case Hello: // to the next meeting, where this one has not ended
          this->Greeting = read<HelloMessage>(message);
          break;
        case Leave:
          this->Greeting.reset();
          this->Close();
          break;
        default:
          this->Messages.push_back(std::move(message));
          break;
      }
    }
  }

private:
  bool HasArrived()
  {
    int has = 0;
#if VTK_MODULE_ENABLE_VTK_ParallelMPI // else there are no other ranks
    if (auto* mpi = vtkMPIController::SafeDownCast(this->Controller))
    {
      mpi->Iprobe(this->Rank, this->Tag, &has, nullptr);
    }
#endif
    return has != 0;
  }

  static constexpr std::int64_t largestSmall = 1 << 16;
  static constexpr std::size_t largestPiece = std::size_t{ 1 } << 30; // MPI counts by integers

  /// Calls visit(first, count) for the pieces of a message.
  template <class Visit>
  static void ForPieces(std::size_t size, const Visit& visit)
  {
    for (std::size_t first = 0; first < size; first += largestPiece)
    {
      visit(first, static_cast<int>(std::min(largestPiece, size - first)));
    }
  }

  void Receive(char* bytes, std::size_t size)
  {
    ForPieces(size,
      [&](std::size_t first, int count)
      { this->Controller->Receive(bytes + first, count, this->Rank, this->Tag); });
  }

  // MPI's own way to send may wait until the other process receives, however little it is.
#if VTK_MODULE_ENABLE_VTK_ParallelMPI // else there are no other ranks
  struct Unsent
  {
    std::vector<char> bytes;
    std::vector<vtkMPICommunicator::Request> requests;
  };
  std::list<Unsent> Outgoing; // which MPI reads

  void Begin(std::vector<char> bytes)
  {
    auto* mpi = vtkMPIController::SafeDownCast(this->Controller);
    this->Outgoing.push_back({ std::move(bytes), {} });
    Unsent& last = this->Outgoing.back();
    ForPieces(last.bytes.size(),
      [&](std::size_t first, int count)
      {
        last.requests.emplace_back();
        mpi->NoBlockSend(static_cast<const char*>(last.bytes.data()) + first, count, this->Rank,
          this->Tag, last.requests.back());
      });
  }
  bool HasUnsent()
  {
    const auto isSent = [](vtkMPICommunicator::Request& request) { return request.Test() != 0; };
    while (!this->Outgoing.empty())
    {
      std::vector<vtkMPICommunicator::Request>& requests = this->Outgoing.front().requests;
      while (!requests.empty() && isSent(requests.back()))
      {
        requests.pop_back();
      }
      if (!requests.empty())
      {
        return true;
      }
      this->Outgoing.pop_front();
    }
    return false;
  }
#else
  void Begin(std::vector<char>) {}
  bool HasUnsent() { return false; }
#endif

  vtkMultiProcessController* Controller;
  int Rank, Tag;
  std::deque<std::vector<char>> Messages;
};

} // namespace ranks

} // namespace filters
