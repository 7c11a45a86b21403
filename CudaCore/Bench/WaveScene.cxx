// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/WaveScene.h"

#include "Bench/StageSettings.h"
#include "Math/NumberText.h"
#include "Waves/ScreenWaves.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace schlieren
{

namespace
{

/// The largest slope of diverging light, at the image's corners. Scaling is that of small angles: of this one the width of
/// fringes is wrong by less than 1 %.
constexpr double largestSlopeOfWaves = 0.1;
double largestSlope(const Scene& scene, const Frame& frame)
{
  const double distance = frame.pupil > 0 ? frame.pupil : scene.source.distance.value_or(0);
  return 0.5 * frame.pixelSize * std::hypot(scene.view.width, scene.view.height) / distance;
}

bool isOfWaves(Cutoff cutoff)
{
  constexpr Cutoff all[] = { Cutoff::Shadowgraph, Cutoff::KnifeEdge, Cutoff::BrightField,
    Cutoff::DarkField, Cutoff::GradedFilter, Cutoff::Interferogram, Cutoff::PhaseContrast };
  return std::find(std::begin(all), std::end(all), cutoff) != std::end(all);
}

} // namespace

std::string thatWaves(const Scene& scene)
{
  return scene.cutoff == Cutoff::PhaseContrast ? "Cutoff is Phase Contrast, which is of waves"
                                               : "LightModel is Waves";
}

std::string orRays(const Scene& scene)
{
  return scene.cutoff == Cutoff::PhaseContrast ? " or Cutoff to another technique."
                                               : " or LightModel to Rays.";
}

LightSource sourceOfWaves(const Scene& scene)
{
  return scene.cutoff == Cutoff::KnifeEdge ? LightSource{} : scene.source;
}

std::string problemOfWaves(const Scene& scene, const Frame& frame)
{
  if (!isOfWaves(scene.cutoff))
  {
    return std::string("LightModel is Waves, but Cutoff is ") + techniqueOf(scene.cutoff).name +
      ", of which no waves are made. Set Cutoff to another technique," + orRays(scene);
  }
  const bool isDiverging = frame.pupil > 0 || scene.source.distance;
  const bool isPlain =
    scene.cutoff == Cutoff::Shadowgraph && scene.source.shape == SourceShape::Point;
  if (isDiverging && (!isPlain || largestSlope(scene, frame) > largestSlopeOfWaves))
  {
    return thatWaves(scene) + ", but light diverges by up to " +
      textOf(largestSlope(scene, frame)) +
      ", and waves take parallel light, or of a Shadowgraph with a point source light that "
      "diverges by no more than 0.1. Set " +
      (frame.pupil > 0 ? "ViewAngle to less (0 is parallel light),"
                       : "SourceDistance to more, or to 0 for collimated light,") +
      orRays(scene);
  }
  if (!(scene.wavelength > 0 && std::isfinite(scene.wavelength) &&
        std::isfinite(1 / scene.wavelength)))
  {
    return "Wavelength is " + textOf(scene.wavelength) + " metres. Set it to a positive number.";
  }
  const PhasePlate& plate = scene.phasePlate;
  if (scene.cutoff == Cutoff::PhaseContrast &&
    !(plate.diameter >= 0 && std::isfinite(plate.diameter) && std::isfinite(plate.delay) &&
      plate.transmission >= 0 && plate.transmission <= 1))
  {
    return "The phase plate has " + textOf(plate.diameter) + " radians, delays light by " +
      textOf(plate.delay) + " waves and transmits " + textOf(plate.transmission) +
      ". Set PhasePlateDiameter to 0 or more, PhasePlateDelay to a finite number and "
      "PhasePlateTransmission between 0 and 1.";
  }
  if (scene.pathModel == PathModel::Straight)
  {
    return thatWaves(scene) +
      ", but PathModel is Straight, and straight rays lack the length of bent paths. Set PathModel "
      "to Refracted," +
      orRays(scene);
  }
  return "";
}

std::int64_t pixelsOfFresnelMargin(
  const Field& field, const Scene& scene, const Frame& frame, const ExitFaces& faces)
{
  if (scene.lightModel == LightModel::Rays || !problemOfWaves(scene, frame).empty())
  {
    return 0;
  }
  const double depth = frame.exit - frame.entry;
  const double farthest = field.lengthScale * (std::abs(filmDistance(scene, frame, faces)) + depth);
  Screen screen;
  screen.source = sourceOfWaves(scene);
  const double pixels =
    marginOnScreen(screen, scene.wavelength, farthest, 0) / (field.lengthScale * frame.pixelSize);
  constexpr double most = 1 << 20; // more than can be traced
  return static_cast<std::int64_t>(std::ceil(std::min(pixels, most)));
}

} // namespace schlieren
