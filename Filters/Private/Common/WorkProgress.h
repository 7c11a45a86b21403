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

/// Reports how much is done, 0 to 1, in the thread that began the work. False cancels it.
using Progress = std::function<bool(double)>;

/// Thrown where the work is cancelled.
struct Stopped
{
};

/// A part of a Progress, for work that ends by an exception where it is cancelled.
class WorkProgress
{
public:
  WorkProgress() = default; // reports to nobody
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

  /// In the thread that began the work.
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

/// Items of a part in forParts().
constexpr vtkIdType partSize = 4096;

/// Calls work(begin, end), from several threads, for parts of 0 to `count`: each begins at a multiple of partSize and
/// ends at the next. There are so many at once that a stop does not wait for long.
template <class Work>
void forParts(vtkIdType count, const WorkProgress& progress, const Work& work)
{
  const vtkIdType parts = (count + partSize - 1) / partSize;
  const vtkIdType atOnce = vtkIdType{ 8 } * vtkSMPTools::GetEstimatedNumberOfThreads();
  for (vtkIdType first = 0; first < parts; first += atOnce)
  {
    const vtkIdType last = std::min(parts, first + atOnce);
    vtkSMPTools::For(first, last, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType part = begin; part < end; ++part)
        {
          work(part * partSize, std::min(count, (part + 1) * partSize));
        }
      });
    progress.reach(static_cast<double>(last) / static_cast<double>(parts));
  }
}

} // namespace filters
