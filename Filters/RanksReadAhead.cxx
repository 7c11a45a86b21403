// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// A meeting of ranks that read the next time step, each in its main thread, while others trace rays.
#include "RanksInternals.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <future>
#include <system_error>

namespace filters
{

using namespace ranks;

//------------------------------------------------------------------------------
bool FilterRanks::Meeting::CanReadAhead() const
{
  const auto& channels = this->Of.Inside->Channels;
  return std::all_of(channels.begin(), channels.end(),
    [](const auto& channel) { return channel->isOpen() && channel->Guest->canReadAhead != 0; });
}

//------------------------------------------------------------------------------
void FilterRanks::Meeting::BeginToRead(double time)
{
  this->Next = time;
  for (const auto& channel : this->Of.Inside->Channels)
  {
    channel->send(messageOf(ReadStepMessage{ ReadStep, time }));
  }
}

//------------------------------------------------------------------------------
void FilterRanks::Meeting::WaitForReaders()
{
  for (const auto& channel : this->Of.Inside->Channels)
  {
    while (channel->isOpen() && !channel->HasRead)
    {
      channel->Poll();
      waitABit();
    }
  }
}

//------------------------------------------------------------------------------
FilterRanks::Meeting::StepAhead FilterRanks::Meeting::MeetAhead(
  const StepAhead& step, const Inputs& own, const std::atomic<bool>& isOver, bool& isAllOnRank0)
{
  StepAhead all = step;
  for (const auto& channel : this->Of.Inside->Channels)
  {
    while (!channel->HasRead && !isOver)
    {
      waitABit();
    }
    if (!channel->HasRead) // the image has failed, or that rank has left
    {
      return {};
    }
    all.isThere = all.isThere && channel->NextStep.isThere != 0;
    all.isKeepable = all.isKeepable && channel->NextStep.isKeepable != 0;
  }
  isAllOnRank0 = true;
  vtkDataObject* const inputs[2] = { own.data, own.bodies };
  for (int input = 0; input < 2 && all.isThere; ++input)
  {
    std::vector<Holdings> holdings{ holdingsOf(inputs[input]) };
    for (const auto& channel : this->Of.Inside->Channels)
    {
      holdings.push_back(channel->NextStep.inputs[input]);
    }
    const std::vector<std::size_t> ranks = ranksWithMore(holdings);
    isAllOnRank0 = isAllOnRank0 && (ranks.empty() || ranks.back() == 0);
  }
  this->Keeps = all.isThere;
  return all;
}

//------------------------------------------------------------------------------
bool FilterRanks::Meeting::ServeAndRead(
  int threads, const Responder& respond, const StepReader& readNext)
{
  StepIsReadMessage result;
  std::atomic<bool> isRead{ false };
  const auto serve = [&]
  {
    for (bool hasSaid = false;;)
    {
      if (isRead && !hasSaid)
      {
        this->Of.Inside->Channels[0]->send(messageOf(result));
        hasSaid = true;
      }
      if (const std::optional<bool> outcome = this->ServeOnce(threads, respond))
      {
        return *outcome;
      }
    }
  };
  std::future<bool> service;
  try
  {
    service = std::async(std::launch::async, serve);
  }
  catch (const std::system_error&) // the system gives no more threads: one after the other
  {
  }
  // Even so: where the others' readers wait for each other, they wait for this one, too.
  Inputs own;
  StepAhead step;
  try
  {
    step = readNext(*this->Next, own);
  }
  catch (const std::exception&) // the request for that step will say it
  {
  }
  result.isThere = step.isThere ? 1 : 0;
  result.isKeepable = step.isKeepable ? 1 : 0;
  result.inputs[0] = holdingsOf(own.data);
  result.inputs[1] = holdingsOf(own.bodies);
  isRead = true;
  return service.valid() ? service.get() : serve();
}

} // namespace filters
