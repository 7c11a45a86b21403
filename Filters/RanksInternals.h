// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RankChannel.h"
#include "RankHoldings.h"
#include "RankPeers.h"
#include "Ranks.h"

#include "vtkMultiProcessController.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPIController.h"
#endif

#include <memory>
#include <vector>

/// The connections of a filter to the other ranks.
struct filters::FilterRanks::Others
{
  /// With three tags from this one on.
  Others(vtkMultiProcessController* controller, int tag)
    : Own(communicatorOf(controller))
    , Peers(this->Own, tag + 2)
  {
    const bool isFirst = controller->GetLocalProcessId() == 0;
    const int ranks = controller->GetNumberOfProcesses();
    for (int rank = isFirst ? 1 : 0; rank < (isFirst ? ranks : 1); ++rank)
    {
      this->Channels.push_back(std::make_unique<ranks::RankChannel>(this->Own, rank, tag));
    }
  }

  std::vector<ranks::Holdings> HoldingsOf(int input, vtkDataObject* own) const;

  // Of all ranks. An object of its own, as readers use the controller's while another thread uses this one.
  vtkSmartPointer<ranks::Communicator> Own;
  std::vector<std::unique_ptr<ranks::RankChannel>>
    Channels;                  // on rank 0: to all others; there: to it
  ranks::RankPeers Peers;      // not on rank 0
  schlieren::RayWorker Worker; // likewise
  int Meetings = 0;            // likewise

private:
  static vtkSmartPointer<ranks::Communicator> communicatorOf(vtkMultiProcessController* controller)
  {
#if VTK_MODULE_ENABLE_VTK_ParallelMPI
    auto copy = vtkSmartPointer<ranks::Communicator>::New();
    copy->CopyFrom(vtkMPICommunicator::SafeDownCast(controller->GetCommunicator()));
    return copy;
#else
    return controller->GetCommunicator();
#endif
  }
};
