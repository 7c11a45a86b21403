// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/ImageStatus.h"

#include "NumberText.h"

#include "Schlieren.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace filters
{

namespace
{

/// Returns a text such as "2 of 4 samples per pixel", or "4 samples per pixel, 32 at edges of bodies".
std::string samplesInWords(const schlieren::Image& image)
{
  const std::string wanted = std::to_string(image.samplesPerPixel);
  const bool isWhole = image.samples == image.samplesPerPixel;
  return (isWhole ? wanted : std::to_string(image.samples) + " of " + wanted) +
    (image.samplesPerPixel == 1 ? " sample per pixel" : " samples per pixel") +
    (image.samplesAtEdges > 0 ? ", " + std::to_string(image.samplesAtEdges) + " at edges of bodies"
                              : "");
}

/// Returns a text such as ", about 3 min more" for the samples that are missing; empty if that is
/// unknown or a moment.
std::string restInWords(const schlieren::Image& image, double raysPerSecond)
{
  constexpr double moment = 5, minute = 60, hour = 3600; // seconds
  const double rays = static_cast<double>(image.width) * image.height *
    std::max(0, image.samplesPerPixel - image.samples);
  const double seconds = raysPerSecond > 0 ? rays / raysPerSecond : 0;
  return seconds < moment    ? ""
    : seconds < 1.5 * minute ? textOf(", about %.0f s more", seconds)
    : seconds < 1.5 * hour   ? textOf(", about %.0f min more", seconds / minute)
                             : textOf(", about %.0f h more", seconds / hour);
}

/// Returns a text such as "85 million rays/s".
std::string speedInWords(double raysPerSecond)
{
  constexpr double million = 1e6;
  return raysPerSecond >= 10 * million ? textOf("%.0f million rays/s", raysPerSecond / million)
    : raysPerSecond >= 0.1 * million   ? textOf("%.1f million rays/s", raysPerSecond / million)
                                       : textOf("%.0f rays/s", raysPerSecond);
}

std::string deviceInWords(const schlieren::Image& image)
{
  const std::string ranks =
    image.processes > 1 ? " on each of " + std::to_string(image.processes) + " ranks" : "";
  if (image.device == schlieren::Device::Cuda)
  {
    return "CUDA" + ranks;
  }
  const std::string threads =
    std::to_string(image.threads) + (image.threads == 1 ? " thread" : " threads");
  return "CPU (" + threads + ranks + ")";
}

/// Describes the path model.
/// Omits MomentumDrift, which does not bound errors of direction.
std::string accuracyInWords(const schlieren::Image& image, const schlieren::Scene& scene)
{
  if (image.pathModel == schlieren::PathModel::Straight)
  {
    return "straight rays, bending left out";
  }
  return image.integrator == scene.integrator
    ? "refracted rays"
    : "refracted rays, with short steps where the index jumps";
}

} // namespace

std::string limitInWords(const schlieren::Accuracy& accuracy)
{
  switch (accuracy.limit)
  {
    case schlieren::ErrorSource::Steps:
      return "the length of steps";
    case schlieren::ErrorSource::RaysPerPixel:
      return "rays per pixel";
    case schlieren::ErrorSource::Voxels:
      return "the size of voxels";
    case schlieren::ErrorSource::Rounding:
      return "rounding";
    case schlieren::ErrorSource::None:
      break;
  }
  return "nothing";
}

std::string errorInWords(const schlieren::Accuracy& accuracy, const schlieren::Scene& scene)
{
  const schlieren::Technique& technique = schlieren::techniqueOf(scene.cutoff);
  const char* unit = technique.hasFringes                     ? " fringes"
    : technique.plane == schlieren::RecordedPlane::Background ? " pixels of displacement"
    : technique.plane == schlieren::RecordedPlane::Screen     ? " of the undisturbed light"
                                                              : " of full scale";
  return (accuracy.isKept() ? "error " : "target error not kept: ") + textOf(accuracy.reached, 2) +
    unit + " (target " + textOf(accuracy.target, 2) + ")";
}

std::string wavesInWords(const schlieren::Image& image)
{
  const schlieren::WaveReport& waves = image.waves;
  if (!image.lightNote.empty())
  {
    return "waves: " + image.lightNote;
  }
  if (!(waves.fresnelWidth > 0))
  {
    return "";
  }
  constexpr double millimetre = 1e-3;
  constexpr double hidesLittle = 0.5 * schlieren::blurThatHidesWaves;
  const double ratio = waves.blur / waves.fresnelWidth;
  const std::string widths = "the Fresnel width is " + textOf(waves.fresnelWidth / millimetre, 3) +
    " mm, a pixel with the source's image " + textOf(waves.blur / millimetre, 3) + " mm";
  return ratio < hidesLittle                ? "waves, which matter: " + widths
    : ratio < schlieren::blurThatHidesWaves ? "waves, which matter at edges and caustics: " + widths
                                            : "waves, but rays would suffice: " + widths;
}

double blockedShare(const schlieren::Image& image)
{
  const double sum =
    std::accumulate(image.blockedFraction.begin(), image.blockedFraction.end(), 0.);
  return sum / std::max(1., static_cast<double>(image.blockedFraction.size()));
}

std::string outsideInWords(const schlieren::Image& image, bool isAlone)
{
  const double share = blockedShare(image);
  return share < 0.001 ? ""
                       : textOf(100 * share, 2) + " % of the image is blocked " +
      (isAlone ? "" : "by solids and ") + "where no cell is (Outside)";
}

std::string statusInWords(
  const schlieren::Image& image, const schlieren::Scene& scene, double raysPerSecond)
{
  std::string words = samplesInWords(image) + restInWords(image, raysPerSecond) + ", ";
  if (raysPerSecond > 0)
  {
    words += speedInWords(raysPerSecond) + " on ";
  }
  const std::string waves = wavesInWords(image);
  const std::string limit = image.accuracy.limit == schlieren::ErrorSource::None
    ? ""
    : ", limited by " + limitInWords(image.accuracy);
  return words + deviceInWords(image) + ", " + accuracyInWords(image, scene) +
    (waves.empty() ? "" : ", " + waves) +
    (image.accuracy.target > 0  ? ", " + errorInWords(image.accuracy, scene) + limit
        : scene.targetError > 0 ? ", error not known yet"
                                : "");
}

} // namespace filters
