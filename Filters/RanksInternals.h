// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RankChannel.h"
#include "RankHoldings.h"
#include "Ranks.h"

#include "vtkDIYUtilities.h"
#include "vtkMultiProcessController.h"
#include "vtkSmartPointer.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPIController.h"
#endif

#include <memory>
#include <vector>

namespace filters
{
namespace ranks
{
/// One rank can have so many times as many cells of an image as of a mesh: it takes some 10 bytes a point, a mesh some 200,
/// and less time; and the medium of an image that one rank has is its own grid, which is exact.
inline constexpr double cellsOfImageForOne = 160;

/// Whether another rank says it of this version of the inputs.
template <class Message, class Version>
bool isOf(const Version& version, const Message& message)
{
  return message.changes == version.changes && message.timeStep == version.timeStep;
}

/// Whether data stay on the ranks that have them.
bool canStay(const std::vector<InputsOfRank>& ofRanks, double maxCells);

/// On rank 0: all of an input, of which other ranks have some; null where rank 0 has all. Throws std::runtime_error where it
/// cannot be had.
vtkSmartPointer<vtkDataObject> collect(int input, const FilterRanks::Inputs& own,
  const std::vector<InputsOfRank>& ofRanks,
  const std::vector<std::unique_ptr<RankChannel>>& channels);
/// On other ranks: the answer to GiveData.
std::vector<char> dataMessage(int input, const FilterRanks::Inputs& own);
} // namespace ranks
} // namespace filters

/// The connections of a filter to the other ranks.
struct filters::FilterRanks::Others
{
  static constexpr int Tags = 2;
  /// With so many tags from this one on.
  Others(vtkMultiProcessController* controller, int tag)
    : Of(vtkDIYUtilities::GetCommunicator(controller))
  {
    const bool isFirst = controller->GetLocalProcessId() == 0;
    const int ranks = controller->GetNumberOfProcesses();
    for (int rank = isFirst ? 1 : 0; rank < (isFirst ? ranks : 1); ++rank)
    {
      this->Channels.push_back(std::make_unique<ranks::RankChannel>(this->Of, rank, tag));
    }
  }

  ranks::Communicator Of; // all ranks
  std::vector<std::unique_ptr<ranks::RankChannel>>
    Channels;                  // on rank 0: to all others; there: to it
  schlieren::RayWorker Worker; // not on rank 0
  int Meetings = 0;            // likewise
};
