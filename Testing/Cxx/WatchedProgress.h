// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkAlgorithm.h"
#include "vtkCommand.h"

#include <limits>
#include <vector>

/// Keeps the progress of a filter's updates, and aborts those that have come as far as `stopAt`.
class WatchedProgress
{
public:
  explicit WatchedProgress(
    vtkAlgorithm* filter, double stopFrom = std::numeric_limits<double>::infinity())
    : stopAt(stopFrom)
    , filter_(filter)
    , tag_(filter->AddObserver(vtkCommand::ProgressEvent, this, &WatchedProgress::see))
  {
  }
  WatchedProgress(const WatchedProgress&) = delete;
  WatchedProgress& operator=(const WatchedProgress&) = delete;
  ~WatchedProgress() { filter_->RemoveObserver(tag_); }

  double stopAt;
  std::vector<double> seen;

private:
  void see(vtkObject*, unsigned long, void* progress)
  {
    seen.push_back(*static_cast<double*>(progress));
    if (seen.back() >= stopAt)
    {
      filter_->SetAbortExecute(1);
    }
  }

  vtkAlgorithm* filter_;
  unsigned long tag_;
};
