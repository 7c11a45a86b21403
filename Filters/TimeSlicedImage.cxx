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

} // namespace

//------------------------------------------------------------------------------
TimeSlicedImage::TimeSlicedImage() { this->Bench.setMedia(mediaOfProcess()); }

//------------------------------------------------------------------------------
schlieren::Image TimeSlicedImage::Begin(const schlieren::Field& field,
  const schlieren::Scene& scene, double seconds, const schlieren::Monitor& monitor)
{
  this->Scene = scene;
  this->RaysBefore = this->Bench.work().raysTraced;
  return this->Noted(this->Bench.render(field, scene, limited(monitor, seconds)));
}

//------------------------------------------------------------------------------
schlieren::Image TimeSlicedImage::Resume(double seconds, const schlieren::Monitor& monitor)
{
  return this->Noted(this->Bench.resume(limited(monitor, seconds)));
}

//------------------------------------------------------------------------------
schlieren::Image TimeSlicedImage::Noted(schlieren::Image image)
{
  const std::int64_t rays = this->Bench.work().raysTraced - this->RaysBefore;
  if (rays > 0 && image.traceSeconds > 0)
  {
    this->RaysPerSecond = static_cast<double>(rays) / image.traceSeconds;
  }
  return image;
}

//------------------------------------------------------------------------------
std::string TimeSlicedImage::GetStatus(const schlieren::Image& image) const
{
  return statusInWords(image, this->Scene, this->RaysPerSecond);
}

//------------------------------------------------------------------------------
std::vector<std::string> TimeSlicedImage::GetWarnings(const schlieren::Image& image)
{
  const std::string warnings[] = { image.deviceNote,
    image.raysTraced > 0 && image.raysBlocked == image.raysTraced
      ? "All light that meets the data is blocked, so the image is black there: every ray meets "
        "a place that is solid (NaN, masked, blanked, a body) or that no cell covers. Look along "
        "another ViewDirection, or let light pass where no cell is with OutsideBlocksLight off."
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
    const std::int64_t rays = this->Bench.work().raySets;
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
