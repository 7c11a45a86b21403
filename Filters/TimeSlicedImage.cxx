// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "TimeSlicedImage.h"

#include "ImageStatus.h"
#include "SharedRefractivity.h"

#include <chrono>
#include <optional>

namespace filters
{

namespace
{

/// Adds a pause after so much time. It runs from the first question on: before that the medium is made, which
/// takes what it takes, and would leave nothing for the image.
schlieren::Monitor limited(const schlieren::Monitor& monitor, double seconds)
{
  using Clock = std::chrono::steady_clock;
  schlieren::Monitor with = monitor;
  if (seconds > 0)
  {
    with.paused = [seconds, start = std::optional<Clock::time_point>()]() mutable
    {
      const Clock::time_point now = Clock::now();
      start = start.value_or(now);
      return std::chrono::duration<double>(now - *start).count() >= seconds;
    };
  }
  return with;
}

void add(schlieren::Work& sum, const schlieren::Work& work)
{
  sum.mediumBuilds += work.mediumBuilds;
  sum.raySets += work.raySets;
  sum.raysTraced += work.raysTraced;
}

PathDifference::MonitorOf limitedBy(const schlieren::Monitor& monitor, double seconds)
{
  return [monitor, seconds](double fraction) { return limited(monitor, fraction * seconds); };
}

} // namespace

//------------------------------------------------------------------------------
TimeSlicedImage::TimeSlicedImage()
{
  this->Bench.setMedia(mediaOfProcess());
  this->StraightBench.setMedia(mediaOfProcess());
}

//------------------------------------------------------------------------------
schlieren::Image TimeSlicedImage::Begin(const schlieren::Field& field,
  const schlieren::Scene& scene, Paths paths, double seconds, const schlieren::Monitor& monitor)
{
  this->Scene = scene;
  this->Difference.Cancel();
  const bool wasDifference = this->IsDifference;
  this->IsDifference = paths == Paths::Difference;
  if (wasDifference && !this->IsDifference) // what it has cached would not be used
  {
    add(this->WorkBefore, this->StraightBench.work());
    this->StraightBench = {};
    this->StraightBench.setMedia(mediaOfProcess());
  }
  this->RaysBefore = this->GetWork().raysTraced;
  return this->Noted(this->IsDifference
      ? this->Difference.Begin(field, scene, limitedBy(monitor, seconds))
      : this->Bench.render(field, scene, limited(monitor, seconds)));
}

//------------------------------------------------------------------------------
schlieren::Image TimeSlicedImage::Resume(double seconds, const schlieren::Monitor& monitor)
{
  return this->Noted(this->Difference.IsUnfinished()
      ? this->Difference.Resume(limitedBy(monitor, seconds))
      : this->Bench.resume(limited(monitor, seconds)));
}

//------------------------------------------------------------------------------
void TimeSlicedImage::SetWorkers(const std::vector<schlieren::Channel*>& workers)
{
  this->Bench.setWorkers(workers);
  this->StraightBench.setWorkers(workers);
}

//------------------------------------------------------------------------------
schlieren::Work TimeSlicedImage::GetWork() const
{
  schlieren::Work work = this->WorkBefore;
  add(work, this->Bench.work());
  add(work, this->StraightBench.work());
  return work;
}

//------------------------------------------------------------------------------
schlieren::Image TimeSlicedImage::Noted(schlieren::Image image)
{
  const std::int64_t rays = this->GetWork().raysTraced - this->RaysBefore;
  if (rays > 0 && image.traceSeconds > 0)
  {
    this->RaysPerSecond = static_cast<double>(rays) / image.traceSeconds;
  }
  return image;
}

//------------------------------------------------------------------------------
std::string TimeSlicedImage::GetStatus(const schlieren::Image& image) const
{
  return statusInWords(image, this->Scene, this->RaysPerSecond) +
    (this->IsDifference ? " less straight ones" : "");
}

//------------------------------------------------------------------------------
std::vector<std::string> TimeSlicedImage::GetWarnings(const schlieren::Image& image)
{
  const std::string warnings[] = { image.deviceNote,
    image.raysTraced > 0 && image.raysBlocked == image.raysTraced
      ? "All light that meets the data is blocked, so the image is black there: every ray meets "
        "a place that is solid (NaN, masked, blanked, a body) or that no cell covers. Look along "
        "another ViewDirection, or let light pass where no cell is with Outside set to Passes."
      : "",
    image.raysLost > 0
      ? std::to_string(image.raysLost) + " of " + std::to_string(image.raysTraced) +
        " rays did not come out towards the film: the medium traps them or turns them back. Is the "
        "refractivity (array, unit, index model) right?"
      : "" };
  std::vector<std::string> news;
  std::int64_t* warnedOf = this->WarnedOf;
  for (const std::string& warning : warnings)
  {
    const std::int64_t rays = this->GetWork().raySets;
    if (!warning.empty() && *warnedOf != rays)
    {
      *warnedOf = rays;
      news.push_back(warning);
    }
    ++warnedOf;
  }
  return news;
}

} // namespace filters
