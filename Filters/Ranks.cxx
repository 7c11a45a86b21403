// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks.h"

#include "DataParts.h"
#include "InputDescription.h"
#include "RanksInternals.h"

#include "vtkAlgorithm.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkRectilinearGrid.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <thread>
#include <utility>

namespace filters
{

using namespace ranks;

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr int firstTag = 21300; // a number that nobody else uses

/// How long a rank waits for others that may not come: they read about as much as it has, or nothing.
constexpr double secondsForInputs = 10;
constexpr double partsOfOwnTime = 10;
constexpr double secondsWithout = 2; // where nothing upstream runs

/// Null where there is one process.
vtkMultiProcessController* controllerOfRanks()
{
#if VTK_MODULE_ENABLE_VTK_ParallelMPI
  auto* controller =
    vtkMPIController::SafeDownCast(vtkMultiProcessController::GetGlobalController());
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
#else
  return nullptr;
#endif
}

/// Whether ranks may have pieces of such data that stay, as far as is known before there are any.
bool isDivisible(vtkInformation* inInfo, double maxCells)
{
  vtkDataObject* data = vtkDataObject::GetData(inInfo);
  if (vtkImageData::SafeDownCast(data) && inInfo->Has(Pipeline::WHOLE_EXTENT()))
  {
    const int* whole = inInfo->Get(Pipeline::WHOLE_EXTENT());
    double cells = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      cells *= whole[2 * axis + 1] - whole[2 * axis]; // 0: it is flat
    }
    return cells > cellsOfImageForOne * maxCells;
  }
  return vtkUnstructuredGrid::SafeDownCast(data) || vtkRectilinearGrid::SafeDownCast(data) ||
    vtkStructuredGrid::SafeDownCast(data) || vtkMultiBlockDataSet::SafeDownCast(data) ||
    vtkPartitionedDataSetCollection::SafeDownCast(data) ||
    vtkPartitionedDataSet::SafeDownCast(data) || vtkUniformGridAMR::SafeDownCast(data);
}

void requestPiece(vtkInformation* inInfo, int piece, int pieces)
{
  if (inInfo->Has(Pipeline::WHOLE_EXTENT()) &&
    isGrid(vtkDataSet::SafeDownCast(vtkDataObject::GetData(inInfo))))
  {
    // VTK divides it by the piece.
    inInfo->Set(Pipeline::UPDATE_EXTENT(), inInfo->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  else
  {
    // Others may have the key, too, from images upstream.
    inInfo->Remove(Pipeline::UPDATE_EXTENT());
  }
  inInfo->Set(Pipeline::UPDATE_PIECE_NUMBER(), piece);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), pieces);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

} // namespace

//------------------------------------------------------------------------------
bool isRank0()
{
  vtkMultiProcessController* controller = controllerOfRanks();
  return !controller || controller->GetLocalProcessId() == 0;
}

//------------------------------------------------------------------------------
bool hasOtherRanks() { return controllerOfRanks() != nullptr; }

//------------------------------------------------------------------------------
bool haveOthersCores(int threads)
{
  if (!hasOtherRanks())
  {
    return false;
  }
  bool isAloneOnMachine = false;
  for (const char* name : { "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS" }) // Open MPI, MPICH
  {
    const char* const ranks = std::getenv(name);
    isAloneOnMachine = isAloneOnMachine || (ranks && std::string(ranks) == "1");
  }
  return isAloneOnMachine || threads < static_cast<int>(std::thread::hardware_concurrency());
}

//------------------------------------------------------------------------------
void setComplete(vtkInformationVector* outputs)
{
  for (int port = 0; hasOtherRanks() && port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* outInfo = outputs->GetInformationObject(port);
    vtkInformation* dataInfo = vtkDataObject::GetData(outInfo)->GetInformation();
    dataInfo->Set(vtkDataObject::ALL_PIECES_EXTENT(), outInfo->Get(Pipeline::WHOLE_EXTENT()), 6);
    if (outInfo->Has(vtkDataObject::ALL_PIECES_EXTENT())) // the pipeline will take this one
    {
      outInfo->CopyEntry(dataInfo, vtkDataObject::ALL_PIECES_EXTENT());
    }
  }
}

//------------------------------------------------------------------------------
FilterRanks::FilterRanks() = default;
FilterRanks::~FilterRanks() = default;

//------------------------------------------------------------------------------
void FilterRanks::Note(vtkAlgorithm* filter, vtkInformation* request)
{
  if (request->Has(Pipeline::REQUEST_DATA_OBJECT()))
  {
    this->CountChanges(filter);
    this->WatchUpstream(filter);
  }
  else if (request->Has(Pipeline::REQUEST_UPDATE_EXTENT()))
  {
    this->WatchUpstream(filter);
  }
  else if (request->Has(Pipeline::REQUEST_DATA()))
  {
    this->Upstream.Ignore(); // it comes, whatever it has
  }
}

//------------------------------------------------------------------------------
void FilterRanks::WatchUpstream(vtkAlgorithm* filter)
{
  if (!this->Inside)
  {
    return;
  }
  this->Upstream.Watch(filter,
    [this](const std::string& name)
    {
      for (const auto& channel : this->Inside->Channels)
      {
        channel->send(this->FailureOf(name));
      }
    });
}

//------------------------------------------------------------------------------
std::vector<char> FilterRanks::FailureOf(const std::string& name) const
{
  FailsMessage message;
  message.changes = this->Now.changes;
  message.timeStep = this->Now.timeStep;
  name.copy(message.name, sizeof(message.name) - 1);
  return messageOf(message);
}

//------------------------------------------------------------------------------
void FilterRanks::CountChanges(vtkAlgorithm* filter)
{
  vtkMultiProcessController* controller = controllerOfRanks();
  if (!this->Inside && controller)
  {
    // All ranks run their filters in the same order.
    static int filters = 0;
    constexpr int most = 5700; // all tags are below 32768, which MPI grants
    this->Inside =
      std::make_unique<Others>(controller, firstTag + Others::Tags * (filters++ % most));
  }
  const vtkMTimeType time = upstreamTime(filter);
  if (this->Now.changes == 0 || time > this->CountedAt.GetMTime())
  {
    ++this->Now.changes;
    this->CountedAt.Modified();
    this->SetTooFew(std::numeric_limits<double>::infinity());
  }
}

//------------------------------------------------------------------------------
void FilterRanks::RequestData(vtkInformation* inInfo, Part part, double maxCells) const
{
  vtkMultiProcessController* controller = controllerOfRanks();
  if (part == Part::Piece && maxCells < this->TooFew && controller && isDivisible(inInfo, maxCells))
  {
    requestPiece(inInfo, controller->GetLocalProcessId(), controller->GetNumberOfProcesses());
    return;
  }
  const bool isWanted = isRank0();
  if (inInfo->Has(Pipeline::WHOLE_EXTENT()))
  {
    const int nothing[6] = { 0, -1, 0, -1, 0, -1 };
    inInfo->Set(
      Pipeline::UPDATE_EXTENT(), isWanted ? inInfo->Get(Pipeline::WHOLE_EXTENT()) : nothing, 6);
  }
  else
  {
    // The pipeline has put the image's there, which blocks would hand on to images upstream.
    inInfo->Remove(Pipeline::UPDATE_EXTENT());
  }
  // A piece that is out of range is empty, as VTK has it. Many sources divide by the number of pieces, so
  // that it cannot be 0; and those that do not check the piece find nothing where it is larger than what
  // they divide.
  constexpr int manyPieces = 1 << 15;
  inInfo->Set(Pipeline::UPDATE_PIECE_NUMBER(), isWanted ? 0 : manyPieces);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), isWanted ? 1 : manyPieces);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

//------------------------------------------------------------------------------
bool FilterRanks::Request(
  vtkAlgorithm* filter, vtkInformationVector** inputs, Part part, double maxCells)
{
  part = maxCells >= this->TooFew ? Part::All : part;
  this->RequestedAt = Clock::now();
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    vtkInformation* inInfo = inputs[port]->GetInformationObject(0);
    if (!inInfo)
    {
      continue;
    }
    if (inInfo->Has(Pipeline::UPDATE_TIME_STEP()))
    {
      this->Now.timeStep = inInfo->Get(Pipeline::UPDATE_TIME_STEP());
    }
    this->RequestData(inInfo, port == 0 ? part : Part::All, maxCells);
  }
  if (part != this->RequestedPart)
  {
    ++this->Now.changes; // all ranks have the same properties
    this->RequestedPart = part;
  }
  const bool isAnother = !(this->Requested == this->Now);
  this->Requested = this->Now;
  return isAnother;
}

//------------------------------------------------------------------------------
FilterRanks::Meeting::Meeting(FilterRanks& ranks, const std::optional<Inputs>& inputs)
  : Of(ranks)
  , Own(inputs)
{
  if (!this->Of.Inside)
  {
    return;
  }
  const bool areNew = inputs && !(this->Of.Compared == this->Of.Now);
  const Clock::time_point now = Clock::now();
  const double ownTime = Seconds(now - this->Of.RequestedAt).count();
  const double limit = areNew ? secondsForInputs + partsOfOwnTime * ownTime : secondsWithout;
  const Clock::time_point end = now + std::chrono::duration_cast<Clock::duration>(Seconds(limit));
  if (areNew)
  {
    this->Of.CountedAt.Modified(); // what is upstream has run, and may have modified itself
  }
  if (isRank0())
  {
    this->WaitForOthers(end);
    return;
  }
  if (areNew)
  {
    this->Of.Compared = this->Of.Now;
  }
  this->WaitForRank0(end);
}

//------------------------------------------------------------------------------
bool FilterRanks::Meeting::HasFailed(const ranks::RankChannel& channel) const
{
  return channel.Failure && isOf(this->Of.Now, *channel.Failure);
}

//------------------------------------------------------------------------------
void FilterRanks::Meeting::WaitForOthers(Clock::time_point end)
{
  for (const auto& channel : this->Of.Inside->Channels)
  {
    channel->Poll();
    while (!channel->Greeting && !this->HasFailed(*channel) && Clock::now() < end)
    {
      waitABit();
      channel->Poll();
    }
    channel->Close(); // to what is left of meetings before
    channel->Guest = std::exchange(channel->Greeting, std::nullopt);
    if (channel->isOpen())
    {
      channel->send(messageOf(ShortMessage{ Begin, channel->Guest->meeting }));
    }
  }
}

//------------------------------------------------------------------------------
void FilterRanks::Meeting::WaitForRank0(Clock::time_point end)
{
  RankChannel& channel = *this->Of.Inside->Channels[0];
  const int meeting = ++this->Of.Inside->Meetings;
  HelloMessage hello;
  hello.meeting = meeting;
  hello.changes = this->Of.Now.changes;
  hello.timeStep = this->Of.Now.timeStep;
  if (this->Own)
  {
    hello.inputs = inputsOfRank(this->Own->data, this->Own->bodies);
  }
  channel.send(messageOf(hello));
  while (!this->HasMet)
  {
    while (!channel.hasMessage() && !this->HasFailed(channel) && Clock::now() < end)
    {
      waitABit();
    }
    if (!channel.hasMessage())
    {
      channel.Failure.reset();
      channel.send(messageOf(ShortMessage{ Leave, 0 }));
      return;
    }
    const auto message = read<ShortMessage>(channel.receive()); // or of a meeting before
    this->HasMet = message.kind == Begin && message.number == meeting;
  }
}

//------------------------------------------------------------------------------
FilterRanks::Meeting::~Meeting()
{
  if (!this->Of.Inside)
  {
    return;
  }
  if (!isRank0())
  {
    if (this->HasMet && std::uncaught_exceptions() > 0) // rank 0 would wait for an answer
    {
      this->Of.Inside->Channels[0]->send(messageOf(ShortMessage{ Leave, 0 }));
    }
    return;
  }
  for (const auto& channel : this->Of.Inside->Channels)
  {
    if (channel->isOpen())
    {
      channel->send(messageOf(EndMessage{ End, this->Outcome, this->HasImage.value_or(false) }));
    }
    else // if it comes yet, it need not wait for another meeting
    {
      channel->send(this->Of.FailureOf("the meeting"));
    }
  }
  for (const auto& channel : this->Of.Inside->Channels)
  {
    // What it has yet to send of what has failed here it could not send later, and would wait for ever.
    channel->ReceiveOne(Ended);
    channel->Close();
    channel->Failure.reset();
  }
}

//------------------------------------------------------------------------------
bool FilterRanks::Meeting::Serve(int threads, const Responder& respond)
{
  while (this->HasMet)
  {
    if (const std::optional<bool> outcome = this->ServeOnce(threads, respond))
    {
      return *outcome;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
std::optional<bool> FilterRanks::Meeting::ServeOnce(int threads, const Responder& respond)
{
  RankChannel& channel = *this->Of.Inside->Channels[0];
  if (!channel.hasMessage())
  {
    waitABit();
    return {};
  }
  std::optional<std::vector<char>> message = channel.TakeRequest();
  if (!message)
  {
    return {};
  }
  const auto head = read<ShortMessage>(*message);
  switch (head.kind)
  {
    case GiveData:
      channel.send(dataMessage(head.number, *this->Own));
      return {};
    case End:
    {
      const auto end = read<EndMessage>(*message);
      this->HasImage = end.hasImage != 0;
      channel.send(messageOf(ShortMessage{ Ended, 0 }));
      return end.outcome != 0;
    }
    default:
      break;
  }
  std::vector<char> response = respond ? respond(*message) : std::vector<char>();
  if (!response.empty())
  {
    channel.send(std::move(response));
    return {};
  }
  this->Of.Inside->Worker.answer(std::move(*message), channel, threads);
  return {};
}

//------------------------------------------------------------------------------
std::vector<schlieren::Channel*> FilterRanks::Meeting::GetWorkers() const
{
  std::vector<schlieren::Channel*> workers;
  if (this->Of.Inside)
  {
    for (const auto& channel : this->Of.Inside->Channels)
    {
      if (channel->isOpen())
      {
        workers.push_back(channel.get());
      }
    }
  }
  return workers;
}

//------------------------------------------------------------------------------
std::vector<schlieren::Channel*> FilterRanks::Meeting::GetChannels() const
{
  std::vector<schlieren::Channel*> channels;
  if (this->Of.Inside)
  {
    for (const auto& channel : this->Of.Inside->Channels)
    {
      channels.push_back(channel->isOpen() ? channel.get() : nullptr);
    }
  }
  return channels;
}

} // namespace filters
