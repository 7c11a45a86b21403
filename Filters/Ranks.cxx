// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks.h"

#include "InputDescription.h"

#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPIController.h"
#endif

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>
#include <vector>

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

// Rank 0 knows by then that a rank's pipeline has failed: it had nothing to read, or the same as rank 0.
constexpr std::chrono::seconds longestWait{ 20 };
constexpr int firstTag = 21300; // a number that nobody else uses

/// What a rank has of an input: numbers of points and cells, bounds.
using Holdings = std::array<double, 8>;

Holdings holdingsOf(vtkDataObject* input)
{
  Holdings holdings{};
  vtkBoundingBox box;
  for (vtkDataObject* leaf : leavesOf(input))
  {
    auto* data = vtkDataSet::SafeDownCast(leaf);
    if (data && data->GetNumberOfPoints() > 0)
    {
      holdings[0] += static_cast<double>(data->GetNumberOfPoints());
      holdings[1] += static_cast<double>(data->GetNumberOfCells());
      if (vtkUnsignedCharArray* ghosts = data->GetCellGhostArray())
      {
        for (vtkIdType i = 0; i < ghosts->GetNumberOfValues(); ++i)
        {
          holdings[1] -= ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATECELL ? 1 : 0;
        }
      }
      box.AddBounds(data->GetBounds());
    }
  }
  if (box.IsValid())
  {
    box.GetBounds(holdings.data() + 2);
  }
  return holdings;
}

/// Null where there is one process.
vtkMultiProcessController* controllerOfRanks()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}

/// A version of the inputs, and what a rank has of the first one and of the bodies.
struct Message
{
  double changes = 0;
  double timeStep = 0;
  Holdings inputs[2] = {};

  static constexpr vtkIdType size = 2 + 2 * std::tuple_size<Holdings>::value;
  double* data() { return &this->changes; }
};
static_assert(sizeof(Message) == Message::size * sizeof(double), "is sent as an array");

bool hasMessage(vtkMultiProcessController* controller, int rank, int tag)
{
  int has = 0;
#if VTK_MODULE_ENABLE_VTK_ParallelMPI // else there are no other ranks
  if (auto* mpi = vtkMPIController::SafeDownCast(controller))
  {
    mpi->Iprobe(rank, tag, &has, nullptr);
  }
#endif
  return has != 0;
}

/// Receives the message of the version that `wanted` says from a rank. False where there is none in time.
bool receive(vtkMultiProcessController* controller, int rank, int tag,
  std::chrono::steady_clock::time_point end, Message& wanted)
{
  while (true)
  {
    if (hasMessage(controller, rank, tag))
    {
      Message message;
      controller->Receive(message.data(), Message::size, rank, tag);
      if (message.changes == wanted.changes && message.timeStep == wanted.timeStep)
      {
        wanted = message;
        return true;
      } // else it was sent when rank 0 did not run
    }
    else if (std::chrono::steady_clock::now() > end)
    {
      return false;
    }
    else
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
}

/// What is wrong with what each rank has of an input, rank 0 first. Those that have the same as rank 0 got all of
/// it, too.
std::string problemOf(const std::vector<Holdings>& ofRanks, const std::string& input)
{
  int ranks = 1;
  double cells = ofRanks[0][1];
  for (const Holdings& holdings : ofRanks)
  {
    if (holdings[0] > 0 && holdings != ofRanks[0])
    {
      ++ranks;
      cells += holdings[1];
    }
  }
  if (ranks == 1)
  {
    return "";
  }
  const auto text = [](double number) { return std::to_string(static_cast<vtkIdType>(number)); };
  return "Rank 0 has only " + text(ofRanks[0][1]) + " of " + text(cells) + " cells of the " +
    input + ": its reader, or a filter such as Redistribute DataSet, has spread them over " +
    std::to_string(ranks) +
    " ranks, and rank 0 makes the result alone. Use one process, or take the data from before that "
    "filter.";
}

} // namespace

//------------------------------------------------------------------------------
bool isRank0()
{
  vtkMultiProcessController* controller = controllerOfRanks();
  return !controller || controller->GetLocalProcessId() == 0;
}

//------------------------------------------------------------------------------
void setComplete(vtkInformationVector* outputs)
{
  for (int port = 0; controllerOfRanks() && port < outputs->GetNumberOfInformationObjects(); ++port)
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
void InputOnRank0::CountChanges(vtkAlgorithm* filter)
{
  vtkMTimeType time = 0;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    time = std::max(time, upstreamTime(filter, port));
  }
  if (this->Now.changes == 0 || time > this->CountedAt.GetMTime())
  {
    ++this->Now.changes;
    this->CountedAt.Modified();
  }
}

//------------------------------------------------------------------------------
bool InputOnRank0::Request(vtkAlgorithm* filter, vtkInformationVector** inputs)
{
  if (this->Tag == 0 && controllerOfRanks())
  {
    // All ranks run their filters in the same order.
    static int filters = 0;
    this->Tag = firstTag + filters++ % 10000;
  }
  const bool isWanted = isRank0();
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
  const bool isAnother = !(this->Requested == this->Now);
  this->Requested = this->Now;
  return isAnother;
}

//------------------------------------------------------------------------------
const std::string& InputOnRank0::FindMissing(vtkDataObject* input, vtkDataObject* bodies)
{
  vtkMultiProcessController* controller = controllerOfRanks();
  if (!controller || this->Compared == this->Now)
  {
    return this->Problem;
  }
  this->Compared = this->Now;
  this->CountedAt.Modified(); // what is upstream may have modified itself while it ran

  Message own{ static_cast<double>(this->Now.changes), this->Now.timeStep,
    { holdingsOf(input), holdingsOf(bodies) } };
  if (controller->GetLocalProcessId() > 0)
  {
    controller->Send(own.data(), Message::size, 0, this->Tag); // so small that it does not block
    return this->Problem;
  }
  this->Problem.clear();
  const int ranks = controller->GetNumberOfProcesses();
  const auto end = std::chrono::steady_clock::now() + longestWait;
  std::vector<Holdings> ofInput{ own.inputs[0] }, ofBodies{ own.inputs[1] };
  for (int rank = 1; rank < ranks && this->Problem.empty(); ++rank)
  {
    Message message = own;
    if (!receive(controller, rank, this->Tag, end, message))
    {
      this->Problem = "Rank " + std::to_string(rank) + " of " + std::to_string(ranks) +
        " does not say what it has of the input, so it is not known whether rank 0 has all of it. "
        "See what that rank has reported, or use one process.";
    }
    ofInput.push_back(message.inputs[0]);
    ofBodies.push_back(message.inputs[1]);
  }
  if (this->Problem.empty())
  {
    this->Problem = problemOf(ofInput, "input");
  }
  if (this->Problem.empty())
  {
    this->Problem = problemOf(ofBodies, "Bodies");
  }
  return this->Problem;
}
