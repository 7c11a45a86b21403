// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSMPTools.h"
#include "vtkType.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace filters
{

/// Reports progress, 0 to 1, in the thread that began the work. Returns false to cancel it.
using Progress = std::function<bool(double)>;

/// Thrown by cancelled work.
struct Stopped
{
};

/// Maps progress to an interval of a Progress, and throws Stopped where that cancels.
class WorkProgress
{
public:
  WorkProgress() = default; // reports nothing
  explicit WorkProgress(Progress report)
    : Report(std::move(report))
  {
  }

  WorkProgress part(double from, double to) const
  {
    WorkProgress result(*this);
    result.From = this->From + from * (this->To - this->From);
    result.To = this->From + to * (this->To - this->From);
    return result;
  }

  /// Reports progress. Call it in the thread that began the work.
  void reach(double done) const
  {
    if (this->Report && !this->Report(this->From + done * (this->To - this->From)))
    {
      throw Stopped();
    }
  }

private:
  Progress Report;
  double From = 0, To = 1;
};

/// Default length of a chunk of forChunks().
constexpr vtkIdType chunkSize = 4096;

/// Calls work(begin, end) in several threads for chunks of 0 to `count`, which begin at multiples
/// of `size`. Cancels between groups of chunks that are short enough to end soon.
template <class Work>
void forChunks(
  vtkIdType count, const WorkProgress& progress, const Work& work, vtkIdType size = chunkSize)
{
  const vtkIdType chunks = (count + size - 1) / size;
  const vtkIdType atOnce = vtkIdType{ 8 } * vtkSMPTools::GetEstimatedNumberOfThreads();
  for (vtkIdType first = 0; first < chunks; first += atOnce)
  {
    const vtkIdType last = std::min(chunks, first + atOnce);
    vtkSMPTools::For(first, last, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType chunk = begin; chunk < end; ++chunk)
        {
          work(chunk * size, std::min(count, (chunk + 1) * size));
        }
      });
    progress.reach(static_cast<double>(last) / static_cast<double>(chunks));
  }
}

} // namespace filters
