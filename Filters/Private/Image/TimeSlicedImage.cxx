// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/TimeSlicedImage.h"

#include "NumberText.h"

#include "Image/ImageStatus.h"
#include "Sources/RefractivityCache.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>

namespace filters
{

namespace
{

/// Adds a pause after so many seconds. Starts at the first query, so that making the medium, which
/// cannot pause, does not use up the time.
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

TimeSlicedImage::TimeSlicedImage() { this->Bench.setMedia(mediaOfProcess()); }

schlieren::Image TimeSlicedImage::Begin(const schlieren::Field& field,
  const schlieren::Scene& scene, double seconds, const schlieren::Monitor& monitor)
{
  this->Scene = scene;
  this->RaysBefore = this->GetWork().raysTraced;
  return this->Noted(this->Bench.render(field, scene, limited(monitor, seconds)));
}

schlieren::Image TimeSlicedImage::Resume(double seconds, const schlieren::Monitor& monitor)
{
  return this->Noted(this->Bench.resume(limited(monitor, seconds)));
}

void TimeSlicedImage::SetProcesses(schlieren::Processes* processes)
{
  this->Bench.setProcesses(processes);
}

schlieren::Image TimeSlicedImage::Noted(schlieren::Image image)
{
  const std::int64_t rays = this->GetWork().raysTraced - this->RaysBefore;
  if (rays > 0 && image.traceSeconds > 0)
  {
    this->RaysPerSecond = static_cast<double>(rays) / image.traceSeconds;
  }
  return image;
}

std::string TimeSlicedImage::GetStatus(const schlieren::Image& image) const
{
  return statusInWords(image, this->Scene, this->RaysPerSecond);
}

namespace
{

/// Warns if steps do not resolve changes of the index.
std::string driftInWords(const schlieren::Image& image)
{
  constexpr double largest = 0.01;
  if (!(image.momentumDrift > largest))
  {
    return "";
  }
  const schlieren::Vector& at = image.steepestPlace;
  return "The rays' momentum and the refractive index differ by up to " +
    textOf(100 * image.momentumDrift, 3) +
    " % where rays leave the data (MomentumDrift), and deflections may be wrong by as much: the "
    "index changes by up to " +
    textOf(image.steepestChange, 3) + " over one voxel, near (" + textOf(at[0], 3) + ", " +
    textOf(at[1], 3) + ", " + textOf(at[2], 3) +
    "), as at a face of glass. Remove what is no fluid with Threshold (and set Outside to Passes), "
    "set StepSize to less, or make the jump several voxels wide.";
}

/// Warns if the places of fringes are rounded visibly.
std::string roundingInWords(const schlieren::Image& image, const schlieren::Scene& scene)
{
  if (!schlieren::techniqueOf(scene.cutoff).hasFringes)
  {
    return "";
  }
  const bool isSingle = scene.precision == schlieren::Precision::Single;
  constexpr double visible = 0.02;                 // fringes
  const double rounding = isSingle ? 2e-7 : 4e-16; // of a path, measured
  double longest = 0;
  for (const double path : image.opticalPathDifference)
  {
    longest = std::max(longest, std::abs(path)); // never NaN
  }
  const double fringes = longest / scene.wavelength;
  return rounding * fringes > visible ? "Paths differ by up to " + textOf(fringes, 3) +
      " wavelengths, and " + (isSingle ? "single" : "even double") +
      " precision rounds fringes by " + textOf(rounding * fringes, 3) + " of their spacing. " +
      (isSingle ? "Set Precision to Double. " : "") +
      "Is LengthScale, the metres in a data unit, right?"
                                      : "";
}

/// Warns if hardly any light falls on a screen.
std::string darknessInWords(const schlieren::Image& image, const schlieren::Scene& scene)
{
  constexpr double hardlyAny = 0.01;
  const bool isDark =
    schlieren::techniqueOf(scene.cutoff).plane == schlieren::RecordedPlane::Screen &&
    image.light.outside > 0 && image.light.onFilm < hardlyAny * image.light.emitted;
  return isDark ? "Only " + textOf(100 * image.light.onFilm / image.light.emitted, 3) +
      " % of the light falls on the image: the screen is so far away that the rest lands beside "
      "it. "
      "Decrease ScreenDistance."
                : "";
}

/// Warns if a camera focuses on nothing in the image, as where FocusDistance is in another unit.
std::string focusInWords(const schlieren::Image& image, const schlieren::Scene& scene)
{
  const schlieren::Frame& frame = image.frame;
  if (!(scene.lens.aperture > 0) || !(frame.pupil > 0) || !scene.lens.focusDistance)
  {
    return "";
  }
  constexpr double tooFar = 20;
  const double behind = schlieren::isOfCamera(scene.cutoff)
    ? scene.background.distance.value_or(frame.exit - frame.entry)
    : 0;
  const double farthest = frame.pupil + frame.focus - frame.entry + behind;
  return *scene.lens.focusDistance > tooFar * farthest ? "The camera focuses " +
      textOf(*scene.lens.focusDistance) + " data units away, but all that it sees is nearer than " +
      textOf(farthest, 3) + ", and blurred. FocusDistance is in data units, not in millimetres."
                                                       : "";
}

/// Notes an automatic ExitInto if the ambient is not a gas.
std::string exitInWords(const schlieren::Image& image, const schlieren::Scene& scene)
{
  return scene.exitInto == schlieren::ExitInto::Auto && image.exitRefractivity != image.ambient
    ? "n - 1 around the flow is " + textOf(image.ambient, 3) +
      ", as in a liquid, so light is refracted into air (n - 1 = " +
      textOf(image.exitRefractivity, 3) +
      ") where it leaves the data: deflections, screens and patterns are those in air. Set "
      "ExitInto "
      "to Surroundings where all of the light's path is in the liquid, or to Custom, or to Air "
      "without this message."
    : "";
}

} // namespace

std::vector<std::pair<std::string, std::string>> TimeSlicedImage::GetWarnings(
  const schlieren::Image& image)
{
  using Warning = std::pair<std::string, std::string>;
  const std::array<Warning, std::tuple_size_v<decltype(this->WarnedOf)>> warnings{
    Warning{ "device", image.deviceNote },
    { "blocked",
      image.raysTraced > 0 && image.raysBlocked == image.raysTraced
        ? "All light that meets the data is blocked, so the image is black there: every ray meets "
          "a place that is solid (NaN, masked, blanked, a body) or that no cell covers. Look along "
          "another ViewDirection, or let light pass where no cell is with Outside set to Passes."
        : "" },
    { "lost",
      image.raysLost > 0
        ? std::to_string(image.raysLost) + " of " + std::to_string(image.raysTraced) +
          " rays did not come out towards the film: the medium traps them, guides them to and fro "
          "for too "
          "many steps, or turns them back" +
          (image.exitRefractivity < image.ambient
              ? ", or they are totally reflected where they would leave the data (ExitInto)."
              : ".") +
          " Is the refractivity (array, unit, index model) right?"
        : "" },
    { "drift", driftInWords(image) }, { "rounding", roundingInWords(image, this->Scene) },
    { "darkness", darknessInWords(image, this->Scene) },
    { "focus", focusInWords(image, this->Scene) }
  };
  std::vector<Warning> news;
  const std::string exit = exitInWords(image, this->Scene);
  if (!exit.empty() && !std::exchange(this->HasNotedExit, true))
  {
    news.emplace_back("exit", exit);
  }
  auto* warnedOf = this->WarnedOf.begin();
  for (const Warning& warning : warnings)
  {
    const std::int64_t rays = this->GetWork().raySets;
    if (!warning.second.empty() && *warnedOf != rays)
    {
      *warnedOf = rays;
      news.push_back(warning);
    }
    ++warnedOf;
  }
  return news;
}

} // namespace filters
