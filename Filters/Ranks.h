// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkTimeStamp.h"

#include <string>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformationVector;

/// False on the other MPI processes of ParaView where there are several: rank 0 makes what there is one of, the
/// others leave it empty.
bool isRank0();

/// In RequestData, where there are several ranks: says that the outputs are all that will be made of their whole
/// extents. Otherwise, a rank that made nothing would run again, alone, at each update, and with it what is
/// upstream: filters that wait for the other ranks would wait forever.
void setComplete(vtkInformationVector* outputs);

/// How a filter gets all of its input on rank 0. Every rank calls all functions where VTK lets it. No rank but 0
/// waits for another, and it only for a while, so that nothing hangs where a rank does not run: its source has
/// failed, or its output is up to date.
class InputOnRank0
{
public:
  /// In REQUEST_DATA_OBJECT, which comes before anything that reads files and so can fail on one rank alone: counts
  /// the changes of properties upstream, the same on all ranks.
  void CountChanges(vtkAlgorithm* filter);

  /// In RequestUpdateExtent: requests all of the inputs, those there are, on rank 0 and nothing on others. Whether
  /// they have changed since the last request, or their time step has.
  bool Request(vtkAlgorithm* filter, vtkInformationVector** inputs);

  /// In RequestData: what is wrong where rank 0 has not all of the data, which some sources and filters spread
  /// over the ranks whatever is requested. Empty on other ranks, and where all is well.
  const std::string& FindMissing(vtkDataObject* input, vtkDataObject* bodies);

private:
  /// Of the inputs. Other ranks than 0 send what they have of each.
  struct Version
  {
    int changes = 0;
    double timeStep = 0;
  };
  friend bool operator==(const Version& a, const Version& b)
  {
    return a.changes == b.changes && a.timeStep == b.timeStep;
  }

  Version Now;
  vtkTimeStamp CountedAt;
  Version Requested;
  Version Compared;
  std::string Problem; // of Compared
  int Tag = 0;         // of the messages; 0: none yet
};
