// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/RealOptics.h"

#include "NumberText.h"

#include "SchlierenSettings.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace filters
{

namespace
{

[[noreturn]] void refuse(
  const char* property, double value, const std::string& unit, const std::string& advice)
{
  throw std::runtime_error(std::string(property) + " is " + textOf(value, 4) +
    (unit.empty() ? "" : " ") + unit + ", " + advice);
}

void requirePositive(
  const char* property, double value, const std::string& unit, const std::string& owner)
{
  if (!(value > 0) || !std::isfinite(value))
  {
    refuse(property, value, unit, "but it has to be positive. Set it to that of " + owner + ".");
  }
}

/// Requires a length of a camera, which has its own unit.
void requireMillimetres(const char* property, double value, const std::string& owner)
{
  requirePositive(property, value, "mm", owner);
  constexpr double least = 0.5;
  if (value < least)
  {
    refuse(property, value, "mm",
      "but no camera is so small. Set it to " + textOf(1e3 * value, 4) + " if this is in metres.");
  }
}

/// Requires the focal length of a mirror, which is in metres.
void requireMirror(double focalLength, const std::string& owner)
{
  requirePositive("MirrorFocalLength", focalLength, "m", owner);
  constexpr double most = 100;
  if (focalLength > most)
  {
    refuse("MirrorFocalLength", focalLength, "m",
      "but no mirror has so long a one. Set it to " + textOf(1e-3 * focalLength, 4) +
        " if this is in millimetres.");
  }
}

void requireSize(const char* property, double value)
{
  if (!(value >= 0) || !std::isfinite(value))
  {
    refuse(property, value, "mm", "which is no size. Set it to 0 or more.");
  }
}

const schlieren::Technique& techniqueOf(const SchlierenSettings& optics)
{
  return schlieren::techniqueOf(static_cast<schlieren::Cutoff>(optics.Cutoff));
}

/// Returns the k eps over the width that SourceWidth is: of a colour filter's image from -1 to 1, else of the source's.
double kOfWidth(const SchlierenSettings& optics)
{
  return techniqueOf(optics).cutoff == schlieren::Cutoff::ColorFilter ? 2 : 1;
}

} // namespace

bool usesK(const SchlierenSettings& optics) { return techniqueOf(optics).hasK(); }

bool choosesK(const SchlierenSettings& optics)
{
  return usesK(optics) &&
    (optics.KMode == SchlierenSettings::K_AUTOMATIC ||
      optics.KMode == SchlierenSettings::K_AUTOMATIC_KEPT);
}

bool choosesScreen(const schlieren::Scene& scene)
{
  return scene.choosesScreen &&
    schlieren::techniqueOf(scene.cutoff).plane == schlieren::RecordedPlane::Screen;
}

double kOfOptics(const SchlierenSettings& optics)
{
  return optics.MirrorFocalLength > 0 && optics.SourceWidth > 0
    ? optics.MirrorFocalLength * kOfWidth(optics) / (metresPerMillimetre * optics.SourceWidth)
    : std::numeric_limits<double>::quiet_NaN();
}

void setSensitivity(const SchlierenSettings& optics, schlieren::Scene& scene)
{
  scene.cutoffOffset = optics.CutoffOffset;
  if (optics.KMode == SchlierenSettings::K_BENCH)
  {
    requireMirror(optics.MirrorFocalLength, "the second mirror");
    const bool isOfFilter = kOfWidth(optics) > 1;
    requirePositive("SourceWidth", optics.SourceWidth, "mm",
      isOfFilter ? "the colour filter" : "the source's image");
    if (isOfFilter && schlieren::SourceShape(optics.SourceShape) != schlieren::SourceShape::Point)
    {
      throw std::runtime_error(
        "SourceWidth is the width of the colour filter where KMode is Bench, so that of an "
        "extended source is not "
        "known. Set KMode to Value and KScale to 2 MirrorFocalLength over the filter's width.");
    }
    scene.kScale = kOfOptics(optics);
  }
  else if (optics.KMode == SchlierenSettings::K_VALUE)
  {
    scene.kScale = optics.KScale;
  }
}

schlieren::PhasePlate phasePlateFrom(const SchlierenSettings& optics)
{
  schlieren::PhasePlate plate;
  if (optics.PhasePlateDiameter > 0)
  {
    requireMirror(optics.MirrorFocalLength, "the second mirror");
    plate.diameter = metresPerMillimetre * optics.PhasePlateDiameter / optics.MirrorFocalLength;
  }
  plate.delay = optics.PhasePlateDelay;
  plate.transmission = optics.PhasePlateTransmission;
  return plate;
}

std::string weaknessInWords(const SchlierenSettings& optics, double k)
{
  constexpr double seen = 1e-6;
  return k > 0 && techniqueOf(optics).fullScale < seen * k
    ? "weaker than a bench can see (about 1 \xC2\xB5rad)"
    : "";
}

std::string kInWords(double k, bool isKept)
{
  return (isKept ? "k locked at " : "k = ") + textOf(k, 4);
}

std::string sensitivityInWords(const SchlierenSettings& settings, double k, bool isKept)
{
  if (techniqueOf(settings).hasFringes)
  {
    return "a fringe is " + textOf(settings.Wavelength, 4) +
      " nm of optical path: Wavelength, in the group Medium";
  }
  if (!usesK(settings) || !(k > 0))
  {
    return "";
  }
  const double focalLength = settings.MirrorFocalLength;
  // Ranges from undisturbed light to the brightest or darkest.
  const schlieren::Technique& technique = techniqueOf(settings);
  std::string words = kInWords(k, isKept) + ": full scale is a deflection of " +
    textOf(1e3 * technique.fullScale / k, 4) + " mrad";
  if (const std::string weak = weaknessInWords(settings, k); !weak.empty())
  {
    words += ", " + weak;
  }
  else if (focalLength > 0) // no optics have such a k
  {
    words += "; optics: " + textOf(focalLength, 4) + " m focal length, " +
      (kOfWidth(settings) > 1 ? "filter " : "source ") +
      textOf(kOfWidth(settings) * focalLength / k / metresPerMillimetre, 4) + " mm wide";
  }
  if (settings.KMode == SchlierenSettings::K_BENCH && technique.hasEdge)
  {
    words += ", the edge " + textOf(settings.CutoffOffset * settings.SourceWidth, 4) + " mm in";
  }
  return words;
}

std::string cameraInWords(
  const SchlierenSettings& settings, const schlieren::Scene& scene, const schlieren::Image& image)
{
  const schlieren::Frame& frame = image.frame;
  const schlieren::RecordedPlane plane = schlieren::techniqueOf(scene.cutoff).plane;
  const bool hasPattern = plane == schlieren::RecordedPlane::Background;
  const bool hasPupil = frame.pupil > 0;
  if (!(hasPattern || hasPupil) || plane == schlieren::RecordedPlane::Screen)
  {
    return "";
  }
  const double depth = frame.exit - frame.entry;
  const double toPattern = (hasPupil ? frame.focus - frame.entry : 0.5 * depth) +
    scene.background.distance.value_or(depth); // from the flow
  const auto inWords = [&](double length)
  { return lengthInWords(settings.LengthScale * length, 3); };
  std::string words = "camera ";
  if (hasPupil)
  {
    words += inWords(frame.pupil) + " before the focal point, ";
  }
  words += "sees " + inWords(image.width * frame.pixelSize) + " by " +
    inWords(image.height * frame.pixelSize);
  if (hasPattern)
  {
    words += ", a pixel is " + textOf(1e3 * image.patternPixel / toPattern, 3) + " mrad";
  }
  // A thin lens (Raffel 2015, Experiments in Fluids 56, 60, equation 8); parallel light has a telecentric one.
  const double inFocus = scene.lens.focusDistance.value_or(
    hasPattern ? frame.pupil + toPattern : frame.pupil - scene.focusOffset);
  const double blur = hasPupil ? scene.lens.aperture * std::abs(1 - frame.pupil / inFocus)
                               : scene.lens.apertureRatio * toPattern;
  return words + (blur > 0 ? ", the flow is blurred over " + inWords(blur) : "");
}

schlieren::LightSource lightSourceFrom(const SchlierenSettings& optics)
{
  schlieren::LightSource source;
  if (optics.SourceDistance != 0)
  {
    source.distance = optics.SourceDistance;
  }
  source.shape = static_cast<schlieren::SourceShape>(optics.SourceShape);
  if (source.shape != schlieren::SourceShape::Point)
  {
    requireMirror(optics.MirrorFocalLength, "the mirrors");
    requireSize("SourceWidth", optics.SourceWidth);
    source.width = metresPerMillimetre * optics.SourceWidth / optics.MirrorFocalLength;
  }
  if (source.shape == schlieren::SourceShape::Slit)
  {
    requireSize("SourceLength", optics.SourceLength);
    source.length = metresPerMillimetre * optics.SourceLength / optics.MirrorFocalLength;
  }
  return source;
}

schlieren::Lens lensFrom(const SchlierenSettings& settings)
{
  schlieren::Lens lens;
  const double number = settings.FNumber;
  if (number != 0)
  {
    requirePositive("FNumber", number, "", "the lens, or to 0 for a pinhole");
    requireMillimetres("LensFocalLength", settings.LensFocalLength, "the lens");
    lens.aperture =
      metresPerMillimetre * settings.LensFocalLength / (number * settings.LengthScale);
    lens.apertureRatio = 1 / number;
  }
  if (settings.FocusDistance != 0)
  {
    lens.focusDistance = settings.FocusDistance;
  }
  return lens;
}

double viewAngleFrom(
  const SchlierenSettings& settings, const schlieren::View& view, const schlieren::Grid& grid)
{
  if (settings.SensorWidth == 0 || !(settings.LengthScale > 0)) // the tracer reports the latter
  {
    return view.viewAngle;
  }
  requireMillimetres("SensorWidth", settings.SensorWidth, "the sensor, or to 0");
  requireMillimetres("LensFocalLength", settings.LensFocalLength, "the lens");
  const double perMillimetre = metresPerMillimetre / settings.LengthScale; // data units
  const double height = perMillimetre * settings.SensorWidth * view.height / view.width;
  const double focalLength = perMillimetre * settings.LensFocalLength;
  // The sensor is closer to the lens for things far away: the thin lens's equation.
  const auto tangentFor = [&](double distance)
  { return 0.5 * height * (1 / focalLength - 1 / distance); };
  const auto angleOf = [](double tangent)
  { return 2 * vtkMath::DegreesFromRadians(std::atan(tangent)); };
  if (settings.FocusDistance > 0)
  {
    if (!(settings.FocusDistance > focalLength))
    {
      refuse("FocusDistance", settings.FocusDistance, "data units",
        "but a lens focuses on nothing nearer than its LensFocalLength, here " +
          textOf(focalLength, 4) + " data units. Set it to more than that.");
    }
    return angleOf(tangentFor(settings.FocusDistance));
  }
  const bool isOnPattern = techniqueOf(settings).plane == schlieren::RecordedPlane::Background;
  const auto distanceAt = [&](double tangent)
  {
    schlieren::View turned = view;
    turned.viewAngle = angleOf(tangent);
    const schlieren::Frame frame = schlieren::frameOf(grid, turned);
    const double depth = frame.exit - frame.entry;
    const double behind = settings.BackgroundDistance < 0 ? depth : settings.BackgroundDistance;
    return frame.pupil + (isOnPattern ? frame.focus - frame.entry + behind : 0);
  };
  // The distance to what is in focus depends on the angle in its turn.
  constexpr int halvings = 60;
  constexpr double steepest = 11; // below 170 degrees
  double least = 0, most = std::min(0.5 * height / focalLength, steepest);
  for (int i = 0; i < halvings; ++i)
  {
    const double middle = 0.5 * (least + most);
    (tangentFor(distanceAt(middle)) > middle ? least : most) = middle;
  }
  return angleOf(most);
}

double fringeSpacingFrom(
  const SchlierenSettings& settings, const schlieren::Frame& frame, int height)
{
  return settings.FringeSpacing < 0 ? frame.pixelSize * height / -settings.FringeSpacing
                                    : settings.FringeSpacing;
}

} // namespace filters
