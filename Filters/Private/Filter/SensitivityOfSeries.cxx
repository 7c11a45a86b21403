// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// How vtkSchlierenFilter finds one k for a series.
#include "Filter/SchlierenFilterInternals.h"

#include "Common/AtTheEnd.h"
#include "Image/RealOptics.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <utility>
#include <vector>

using namespace filters;

namespace
{

/// Returns the first, the last and others spread evenly, `most` at most.
std::vector<double> spread(const std::vector<double>& times, std::size_t most)
{
  if (times.size() <= most)
  {
    return times;
  }
  std::vector<double> some;
  for (std::size_t i = 0; i < most; ++i)
  {
    some.push_back(times[i * (times.size() - 1) / (most - 1)]);
  }
  return some;
}

} // namespace

void vtkSchlierenFilter::FitKOverSeries()
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (!choosesK(*this))
  {
    vtkErrorMacro(<< "One k for a series is an automatic k. Set KMode to Automatic or Automatic "
                     "Kept, and a Cutoff with a k.");
    return;
  }
  this->UpdateInformation();
  vtkInformation* info =
    this->GetNumberOfInputConnections(0) > 0 ? this->GetInputInformation() : nullptr;
  if (!info || info->Length(Pipeline::TIME_STEPS()) == 0)
  {
    vtkErrorMacro(
      << "The data have no time steps over which k could be fitted. Fit K Again finds it "
         "for one image.");
    return;
  }
  const double* steps = info->Get(Pipeline::TIME_STEPS());
  const std::vector<double> times =
    spread({ steps, steps + info->Length(Pipeline::TIME_STEPS()) }, MOST_STEPS);

  // Whatever happens, settings and time are as before, and k if none is found.
  Internals& inside = *this->Inside;
  vtkInformation* request = this->GetOutputInformation(IMAGE_PORT);
  SensitivityLock& lock = inside.SensitivityLocks[this->Cutoff];
  SensitivityLock kept = lock;
  const bool hasTime = request->Has(Pipeline::UPDATE_TIME_STEP()) != 0;
  const AtTheEnd restore(
    [&, settings = SchlierenSettings(*this),
      time = hasTime ? request->Get(Pipeline::UPDATE_TIME_STEP()) : 0]
    {
      static_cast<SchlierenSettings&>(*this) = settings;
      this->SetProgressShiftScale(0, 1);
      hasTime ? request->Set(Pipeline::UPDATE_TIME_STEP(), time)
              : request->Remove(Pipeline::UPDATE_TIME_STEP());
      lock = kept;
      this->Modified();
    });
  this->PreviewReduction = 1;
  this->TimeLimit = 0;
  this->SamplesPerPixel = 1; // k is chosen from the first ray of each pixel
  this->TargetError = 0;
  double k = 0;
  for (std::size_t i = 0; i < times.size(); ++i)
  {
    const double part = 1. / static_cast<double>(times.size());
    this->SetProgressShiftScale(static_cast<double>(i) * part, part);
    lock.Drop(); // each step has its own
    this->Modified();
    this->UpdateTimeStep(times[i]);
    if (!inside.HasImage || this->GetAbortExecute())
    {
      return; // aborted, maybe as the image was finished, or there is a message
    }
    k = k > 0 ? std::min(k, this->KScaleUsed) : this->KScaleUsed;
  }
  kept.Give(k > 0 ? std::make_optional(k) : std::nullopt);
}
