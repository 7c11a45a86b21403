// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the ranks of a filter send each other to meet, and how.
#pragma once

#include "RankHoldings.h"
#include "RankOutbox.h"

#include "Rays/Channel.h"
#include "Rays/RayWorker.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <deque>
#include <exception>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace filters
{

namespace ranks
{

/// The first bytes of messages. Those of rays have other numbers.
enum Kind : std::uint32_t
{
  Hello = 1,  // to rank 0
  Begin,      // to others: an answer to Hello
  Leave,      // to rank 0, which does not come
  GiveData,   // to others
  Data,       // to rank 0
  End,        // to others
  Ended,      // to rank 0, an answer to End
  Ask,        // to others, before they get pieces
  Ready,      // to rank 0, an answer to Ask
  Relay,      // to others: a message comes in pieces
  Fails       // in place of Hello, and to others: what is upstream has failed
};

struct HelloMessage
{
  std::uint32_t kind = Hello;
  std::int32_t meeting = 0; // of this rank
  double changes = 0;       // the version of the inputs
  double timeStep = 0;
  InputsOfRank inputs;
};
struct FailsMessage
{
  std::uint32_t kind = Fails;
  std::int32_t changes = 0; // the version of the inputs
  double timeStep = 0;
  char name[64] = {}; // the class of what has failed
};
struct EndMessage
{
  std::uint32_t kind = End;
  std::int32_t outcome = 0;
  std::int32_t hasImage = 0;
};
/// Where pieces come from, and where they are sent on to.
struct RelayMessage
{
  std::uint32_t kind = Relay;
  std::int32_t from = 0;
  std::int32_t to[2] = { -1, -1 }; // -1: nowhere
  std::int64_t bytes = 0;
};
struct ShortMessage
{
  std::uint32_t kind = 0;
  // Begin: the meeting; GiveData: the input; Data: 1 with data, 0 with a text
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

/// Messages with this tag; the pieces of those that ranks pass on have the next one.
class RankChannel : public schlieren::Channel
{
public:
  RankChannel(const Communicator& communicator, int rank, int tag)
    : Of(communicator)
    , Rank(rank)
    , Tag(tag)
  {
  }

  void send(std::vector<char> message) override
  {
    const auto size = static_cast<std::int64_t>(message.size());
    std::vector<char> head(sizeof(size));
    std::memcpy(head.data(), &size, sizeof(size));
    this->Outgoing.Send(std::move(head), this->Rank, this->Tag);
    this->Outgoing.Send(std::move(message), this->Rank, this->Tag);
    while (size > largestSmall && this->Outgoing.CountUnsent() > 0)
    {
      waitABit();
    }
  }
  /// The ranks are a binary tree with this one as its root: each sends pieces on to two others while the next ones
  /// arrive. Only those take part that answer, so that nobody waits for one that has left.
  void sendWith(const std::vector<schlieren::Channel*>& others, std::vector<char> message) override
  {
    const auto size = static_cast<std::int64_t>(message.size());
    if (others.empty() && size <= largestSmall)
    {
      this->send(std::move(message));
      return;
    }
    std::vector<RankChannel*> nodes{ this };
    for (schlieren::Channel* other : others)
    {
      nodes.push_back(static_cast<RankChannel*>(other));
    }
    for (RankChannel* node : nodes)
    {
      node->send(messageOf(ShortMessage{ Ask, 0 }));
    }
    nodes.erase(std::remove_if(
                  nodes.begin(), nodes.end(), [](RankChannel* node) { return !node->IsReady(); }),
      nodes.end());
    nodes.insert(nodes.begin(), nullptr); // this process
    const auto rankOf = [&](std::size_t node) {
      return node == 0 ? this->Of.rank() : node < nodes.size() ? nodes[node]->Rank : -1;
    };
    for (std::size_t node = 1; node < nodes.size(); ++node)
    {
      nodes[node]->send(messageOf(RelayMessage{
        Relay, rankOf((node - 1) / 2), { rankOf(2 * node + 1), rankOf(2 * node + 2) }, size }));
    }
    Pieces pieces(*this, { rankOf(1), rankOf(2) });
    for (std::int64_t first = 0; first < size; first += bytesOfPiece)
    {
      const auto end = message.begin() + std::min(first + bytesOfPiece, size);
      pieces.Send({ message.begin() + first, end });
    }
    pieces.Wait();
  }
  /// What comes in pieces, after it has been sent on; empty where there is no memory for it.
  std::vector<char> ReceiveRelayed(const RelayMessage& head)
  {
    std::vector<char> message;
    try
    {
      message.reserve(static_cast<std::size_t>(head.bytes));
    }
    catch (const std::exception&)
    {
    }
    const bool hasRoom = message.capacity() >= static_cast<std::size_t>(head.bytes);
    Pieces pieces(*this, { head.to[0], head.to[1] });
    std::vector<char> piece;
    for (std::int64_t first = 0; first < head.bytes; first += bytesOfPiece)
    {
      this->Of.recv(head.from, this->Tag + 1, piece);
      pieces.Send(piece);
      if (hasRoom)
      {
        message.insert(message.end(), piece.begin(), piece.end());
      }
    }
    pieces.Wait();
    return message;
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
  /// On other ranks: a message that has arrived, whole; unset where it only prepares another one.
  std::optional<std::vector<char>> TakeRequest()
  {
    std::vector<char> message = this->receive();
    switch (read<ShortMessage>(message).kind)
    {
      case Ask:
        this->send(messageOf(ShortMessage{ Ready, 0 }));
        return {};
      case Relay:
        return this->ReceiveRelayed(read<RelayMessage>(message));
      default:
        return message;
    }
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
  // The last time that the other rank's filter has not run.
  std::optional<FailsMessage> Failure;

  /// Leaves the meeting, or a rank 0 that has not come.
  void Close()
  {
    this->Guest.reset();
    this->Messages.clear();
  }

  /// Takes what has arrived.
  void Poll()
  {
    this->Outgoing.CountUnsent();
    while (this->Of.iprobe(this->Rank, this->Tag))
    {
      std::int64_t size = 0;
      const std::vector<char> head = ranks::receive(this->Of, this->Rank, this->Tag, sizeof(size));
      std::memcpy(&size, head.data(), sizeof(size));
      std::vector<char> message = ranks::receive(this->Of, this->Rank, this->Tag, size);
      switch (schlieren::RayWorker::kindOf(message))
      {
        case Hello: // to the next meeting, where this one has not ended
          this->Greeting = read<HelloMessage>(message);
          break;
        case Fails:
          this->Failure = read<FailsMessage>(message);
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
  /// Waits for the answer to Ask. False where the other rank has left.
  bool IsReady()
  {
    while (this->isOpen())
    {
      this->Poll();
      const auto answer = std::find_if(this->Messages.begin(), this->Messages.end(),
        [](const std::vector<char>& message) { return read<ShortMessage>(message).kind == Ready; });
      if (answer != this->Messages.end())
      {
        this->Messages.erase(answer);
        return true;
      }
      waitABit();
    }
    return false;
  }

  static constexpr std::int64_t largestSmall = 1 << 16;
  static constexpr std::int64_t bytesOfPiece = 1 << 18;
  static_assert(bytesOfPiece <= longestPiece);

  /// Pieces of a message on their way to up to two ranks.
  class Pieces
  {
  public:
    Pieces(RankChannel& channel, const std::array<int, 2>& to)
      : Tag(channel.Tag + 1)
      , To(to)
      , Outgoing(channel.Of)
    {
    }
    void Send(const std::vector<char>& piece)
    {
      for (const int rank : this->To)
      {
        if (rank >= 0)
        {
          this->WaitFor(mostUnsent);
          this->Outgoing.Send(piece, rank, this->Tag);
        }
      }
    }
    void Wait() { this->WaitFor(0); }

  private:
    static constexpr std::size_t mostUnsent = 16;
    void WaitFor(std::size_t unsent)
    {
      while (this->Outgoing.CountUnsent() > unsent)
      {
        std::this_thread::yield();
      }
    }

    int Tag;
    std::array<int, 2> To;
    Outbox Outgoing;
  };

  Communicator Of;
  int Rank, Tag;
  Outbox Outgoing{ this->Of };
  std::deque<std::vector<char>> Messages;
};

} // namespace ranks

} // namespace filters
