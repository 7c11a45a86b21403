// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// A meeting of ranks that read the next time step, each in its main thread, while others trace rays.
#include "RanksInternals.h"

#include "vtkDataObject.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <future>
#include <system_error>
#include <utility>

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
  this->HasReaders = true;
  for (const auto& channel : this->Of.Inside->Channels)
  {
    channel->send(messageOf(ReadStepMessage{ ReadStep, time }));
  }
  for (const auto& reader : this->Of.Inside->Readers)
  {
    reader->Open();
  }
}

//------------------------------------------------------------------------------
FilterRanks::Meeting::StepAhead FilterRanks::Meeting::MeetReaders(
  const StepAhead& step, double time, const Inputs& own, double maxCells, Place& place)
{
  this->Of.Ahead.reset();
  StepAhead all = step;
  std::vector<InputsOfRank> ofRanks{ inputsOfRank(own.data, own.bodies) };
  for (const auto& reader : this->Of.Inside->Readers)
  {
    const auto other = read<StepIsReadMessage>(reader->ReceiveOne(StepIsRead));
    all.isThere = all.isThere && other.isThere != 0;
    all.isKeepable = all.isKeepable && other.isKeepable != 0;
    ofRanks.push_back(other.inputs);
  }
  const bool stays = canStay(ofRanks, maxCells);
  place = !hasRank0All(holdingsOf(1, ofRanks)) ? Place::Gathered
    : stays                                    ? Place::InPieces
    : hasRank0All(holdingsOf(0, ofRanks))      ? Place::OnRank0
                                               : Place::Gathered;
  if (all.isThere && place == Place::Gathered && !stays)
  {
    try
    {
      FilterRanks::OfInputs gathered;
      const Inputs withArrays{ own.data, own.bodies, this->Own->arrays };
      for (int input = 0; input < 2; ++input)
      {
        gathered[static_cast<std::size_t>(input)] =
          collect(input, withArrays, ofRanks, this->Of.Inside->Readers);
      }
      this->Of.Ahead = AheadOf{ { this->Of.Now.changes, time }, maxCells, std::move(gathered),
        withArrays.arrays ? withArrays.arrays() : std::vector<std::string>() };
      place = Place::OnRank0;
    }
    catch (const std::exception&) // the request for that step will say it
    {
    }
  }
  return all;
}

//------------------------------------------------------------------------------
std::vector<schlieren::Channel*> FilterRanks::Meeting::GetReaders() const
{
  std::vector<schlieren::Channel*> readers;
  if (this->HasReaders)
  {
    for (const auto& reader : this->Of.Inside->Readers)
    {
      readers.push_back(reader.get());
    }
  }
  return readers;
}

//------------------------------------------------------------------------------
void FilterRanks::Meeting::EndOfStep(bool isKept)
{
  if (!std::exchange(this->HasReaders, false))
  {
    return;
  }
  if (!isKept)
  {
    this->Of.Ahead.reset();
  }
  for (const auto& reader : this->Of.Inside->Readers)
  {
    reader->send(messageOf(ShortMessage{ StepEnds, isKept ? 1 : 0 }));
    reader->Close();
  }
}

//------------------------------------------------------------------------------
void FilterRanks::Meeting::ServeReader(
  const StepAhead& step, const Inputs& own, const Responder& respond)
{
  RankChannel& reader = *this->Of.Inside->Readers[0];
  reader.send(messageOf(StepIsReadMessage{ StepIsRead, step.isThere ? 1 : 0,
    step.isKeepable ? 1 : 0, inputsOfRank(own.data, own.bodies) }));
  for (;;)
  {
    const std::optional<std::vector<char>> message = reader.TakeRequest();
    if (!message)
    {
      continue;
    }
    const auto head = read<ShortMessage>(*message);
    if (head.kind == StepEnds)
    {
      this->Drops = head.number == 0;
      return;
    }
    reader.send(head.kind == GiveData
        ? dataMessage(head.number, { own.data, own.bodies, this->Own->arrays })
        : respond(*message));
  }
}

//------------------------------------------------------------------------------
bool FilterRanks::Meeting::ServeAndRead(int threads, const Responder& respond, const Reader& reader)
{
  const auto serve = [&]
  {
    for (;;)
    {
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
    step = reader.read(*this->Next, own);
  }
  catch (const std::exception&) // the request for that step will say it
  {
  }
  this->ServeReader(step, own, reader.respond);
  return service.valid() ? service.get() : serve();
}

} // namespace filters
