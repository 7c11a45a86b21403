// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChannelRanks.h"

#include "Rays/RayWorker.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace filters
{

namespace
{

[[noreturn]] void throwAbsent(std::size_t rank)
{
  throw std::runtime_error("Rank " + std::to_string(rank) +
    " does not answer for its piece of the input. See what that rank has reported, then update the "
    "filter again.");
}

/// Other messages, of rays that nobody waits for any more, are dropped.
std::vector<char> answerFrom(schlieren::Channel& channel, std::size_t rank)
{
  while (channel.isOpen())
  {
    if (!channel.hasMessage())
    {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
      continue;
    }
    std::vector<char> message = channel.receive();
    if (schlieren::RayWorker::kindOf(message) == PieceWorker::Answer)
    {
      return message;
    }
  }
  throwAbsent(rank);
}

} // namespace

bool ChannelRanks::MayHelp() const
{
  return this->Help && !this->Channels.empty() &&
    std::all_of(this->Channels.begin(), this->Channels.end(),
      [](const schlieren::Channel* channel) { return channel && channel->isOpen(); });
}

std::vector<std::vector<char>> ChannelRanks::Request(
  std::vector<std::vector<char>> requests, const std::function<void()>& meanwhile)
{
  for (std::size_t rank = 1; rank < requests.size(); ++rank)
  {
    const bool isThere = rank <= this->Channels.size() && this->Channels[rank - 1] &&
      this->Channels[rank - 1]->isOpen();
    if (!requests[rank].empty() && !isThere)
    {
      throwAbsent(rank);
    }
  }
  std::vector<std::vector<char>> answers(requests.size());
  std::vector<bool> isAsked;
  for (std::size_t rank = 0; rank < requests.size(); ++rank)
  {
    isAsked.push_back(!requests[rank].empty());
    if (rank > 0 && isAsked[rank])
    {
      this->Channels[rank - 1]->send(std::move(requests[rank]));
    }
  }
  if (isAsked[0])
  {
    answers[0] = this->Own.Respond(requests[0]);
  }
  std::exception_ptr problem;
  try
  {
    if (meanwhile)
    {
      meanwhile();
    }
  }
  catch (...)
  {
    problem = std::current_exception();
  }
  for (std::size_t rank = 1; rank < requests.size(); ++rank)
  {
    if (isAsked[rank])
    {
      try // what is left would be taken for answers to the next request
      {
        answers[rank] = answerFrom(*this->Channels[rank - 1], rank);
      }
      catch (...)
      {
        problem = problem ? problem : std::current_exception();
      }
    }
  }
  if (problem)
  {
    std::rethrow_exception(problem);
  }
  return answers;
}

} // namespace filters
