// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/Validation.h"

#include "Bench/StageSettings.h"
#include "Bench/WaveScene.h"
#include "Film/Smoothing.h"
#include "Math/Units.h"
#include "Medium/Medium.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace schlieren
{

namespace
{

constexpr double shortestStep = 0.001;
constexpr double shortestInSingle = 0.01; ///< with a path that is rounded by 2e-4 of itself
constexpr double longestStep = 16;
constexpr double largestDistance = 1e30; ///< of a film, data units: displacements are floats

template <class... Message>
void require(bool isGood, const Message&... message)
{
  if (!isGood)
  {
    std::ostringstream text;
    (text << ... << message);
    throw Error(text.str());
  }
}

void validateTolerances(const Scene& scene)
{
  require(scene.adaptiveTolerance >= 1e-12 && scene.adaptiveTolerance <= 1, "adaptiveTolerance is ",
    scene.adaptiveTolerance,
    ". Set it between 1e-12 (smaller errors are lost in rounding) and 1 (all steps are as long as "
    "StepSize).");
  require(scene.mediumTolerance >= 0 && scene.mediumTolerance <= 1, "MediumTolerance is ",
    scene.mediumTolerance,
    ". Set it between 0 (voxels are as fine as the data) and 1, as a fraction of the largest "
    "deflection.");
  require(scene.targetError >= 0 && std::isfinite(scene.targetError), "TargetError is ",
    scene.targetError, ". Set it to a positive error, or to 0 for the settings as they are.");
}

void validateImage(const RgbImage& image, const char* name)
{
  const auto width = static_cast<std::size_t>(std::max(image.width, 0));
  const auto height = static_cast<std::size_t>(std::max(image.height, 0));
  require(width > 0 && height > 0 && image.rgb.size() == 3 * width * height, name, " is ",
    image.width, " by ", image.height, " pixels with ", image.rgb.size(),
    " values. Give it at least one pixel, and red, green and blue for each.");
}

/// What the kind of cutoff looks at; the rest may be anything.
void validateCutoff(const Scene& scene)
{
  require(std::isfinite(scene.cutoffOffset), "CutoffOffset is ", scene.cutoffOffset,
    ". Set it to a finite fraction of the source's image: 0 cuts half of it, 1/2 all.");
  if (scene.cutoff == Cutoff::GradedFilter)
  {
    const std::vector<double>& filter = scene.gradedFilter;
    require(filter.size() >= 2, "The number of GradedFilter's values is ", filter.size(),
      ". Give it two or more, from one side to the other.");
    for (const double value : filter)
    {
      require(value >= 0 && value <= 1, "A value of GradedFilter is ", value,
        ", but a filter lets a fraction of the light pass. Set it between 0 and 1.");
    }
  }
  if (scene.cutoff == Cutoff::ColorFilter && scene.colorFilter)
  {
    validateImage(*scene.colorFilter, "ColorFilterImage");
  }
  if (techniqueOf(scene.cutoff).hasFringes)
  {
    require(scene.wavelength > 0 && std::isfinite(1 / scene.wavelength) &&
        std::isfinite(scene.wavelength),
      "Wavelength is ", scene.wavelength, " metres. Set it to a positive number.");
    if (scene.fringes.finite)
    {
      require(scene.fringes.spacing > 0 && std::isfinite(scene.fringes.spacing),
        "FringeSpacing is ", scene.fringes.spacing,
        ", but finite fringes have a spacing. Set it to a positive number of data units, or "
        "FringeSpacing to 0.");
      require(std::isfinite(scene.fringes.angle), "FringeAngle is ", scene.fringes.angle,
        ". Set it to an angle in degrees.");
    }
  }
  constexpr int maxBins = 2048;
  require(scene.histogramSize >= 0 && scene.histogramSize <= maxBins, "HistogramSize is ",
    scene.histogramSize, ". Set it between 0 (no histogram) and 2048.");
}

void validateScene(const Scene& scene)
{
  require(scene.samplesPerPixel >= 1, "SamplesPerPixel is ", scene.samplesPerPixel,
    ", so no light is traced. Set it to 1 or more.");
  require(scene.stepSize >= shortestStep && scene.stepSize <= longestStep, "StepSize is ",
    scene.stepSize,
    " voxels. Set it between 0.001 (shorter ones only take longer) and 16 (longer ones miss the "
    "flow).");
  require(scene.precision == Precision::Double || scene.stepSize >= shortestInSingle,
    "StepSize is ", scene.stepSize,
    " voxels, but the sum of so many steps is rounded too much in single precision. Set it to "
    "0.01 or more, or Precision to Double.");
  validateTolerances(scene);
  require(std::isfinite(scene.knifeEdgeAngle),
    "KnifeEdgeAngle is not finite. Set it to an angle in degrees.");
  validateCutoff(scene);
  const LightSource& source = scene.source;
  require(source.width >= 0 && std::isfinite(source.width) && source.length >= 0 &&
      std::isfinite(source.length),
    "The light source is ", source.width, " by ", source.length,
    " radians. Set SourceWidth and SourceLength to zero or more.");
  const double k = scene.kScale.value_or(0);
  require(k >= 0 && std::isfinite(k), "KScale is ", k,
    ", but it is a focal length divided by a source width. Set it to zero or more; to swap "
    "bright and dark turn KnifeEdgeAngle by 180 degrees.");
  const double screen = scene.screenDistance.value_or(0);
  require(screen >= 0 && screen <= largestDistance, "ScreenDistance is ", screen,
    ". Set it to zero or more, up to 1e30 data units.");
  require(scene.exitInto != ExitInto::Custom ||
      (scene.exitRefractivity > -1 && std::isfinite(scene.exitRefractivity)),
    "ExitRefractivity is ", scene.exitRefractivity,
    ", but it is n - 1 of what light leaves the data into: 2.7e-4 of air, 0.333 of water. Set it "
    "to more than -1, or ExitInto to Air or Surroundings.");
  require(scene.smoothingRadius >= 0 && scene.smoothingRadius <= largestSmoothingRadius,
    "SmoothingRadius is ", scene.smoothingRadius, " pixels. Set it between 0 and ",
    largestSmoothingRadius, "; to blur more, make a smaller image.");
  require(scene.threads >= 0, "The number of threads is ", scene.threads,
    ". Set it to 1 or more, or to 0 for all cores.");
}

/// The lens of a camera, where there is one. `frame`: of the image.
void validateLens(const Scene& scene, const Frame& frame)
{
  const Lens& lens = scene.lens;
  const bool isGood = lens.aperture >= 0 && std::isfinite(lens.aperture) &&
    lens.apertureRatio >= 0 && std::isfinite(lens.apertureRatio);
  require(isGood, "The lens has an aperture of ", lens.aperture,
    " data units. Set FNumber to a positive number, or to 0 for a pinhole.");
  require(
    !lens.focusDistance || (*lens.focusDistance > 0 && *lens.focusDistance <= largestDistance),
    "FocusDistance is ", lens.focusDistance.value_or(0),
    ". Set it to a positive number of data units, or to 0 for the pattern or the focal point.");
  const Aperture aperture = apertureOf(scene, frame, noFaces);
  double slope = aperture.slope;
  if (frame.pupil > 0)
  {
    const double distance = frame.pupil + aperture.focus + frame.focus - frame.entry;
    slope = distance > 0 ? slope * frame.pupil / distance : 0;
  }
  require(slope <= 1, "The lens's aperture is ", 2 * slope,
    " times as wide as its distance from what is in focus. Increase FNumber, so that light is "
    "inclined by no more than 45 "
    "degrees.");
}

/// How light travels: from where, and to what film. `frame`: of the image.
void validateLight(const Scene& scene, const Frame& frame)
{
  const double depth = frame.exit - frame.entry;
  require(std::isfinite(scene.focusOffset), "FocusOffset is ", scene.focusOffset,
    ". Set it to a finite number of data units, 0 for the middle of the data.");
  validateLens(scene, frame);
  if (isOfCamera(scene.cutoff))
  {
    const double distance = scene.background.distance.value_or(depth);
    require(distance >= 0 && distance <= largestDistance, "The background is at a distance of ",
      distance, " from the data. Set BackgroundDistance to zero or more, up to 1e30 data units.");
    require(scene.background.period >= 0 && std::isfinite(scene.background.period),
      "BackgroundPeriod is ", scene.background.period,
      ". Set it to a positive number of data units, or to 0 for eight pixels.");
    require(std::isfinite(scene.background.angle), "FringeAngle is ", scene.background.angle,
      ". Set it to an angle in degrees.");
    if (scene.background.kind == PatternKind::Image)
    {
      require(scene.background.image != nullptr,
        "There is no image behind the flow. Set BackgroundImage, or another BackgroundPattern.");
      validateImage(*scene.background.image, "BackgroundImage");
    }
    return; // light comes from the pattern
  }
  const LightSource& source = scene.source;
  double slope = 0;
  double magnification = 1;
  const bool isFocused = techniqueOf(scene.cutoff).plane == RecordedPlane::Focus;
  if (frame.pupil > 0)
  {
    magnification =
      isFocused && !scene.lens.focusDistance ? 1 - scene.focusOffset / frame.pupil : 1;
    require(magnification > 0, "FocusOffset is ", scene.focusOffset,
      ", so the plane in focus is not in front of the camera, ", frame.pupil,
      " from its focal point. Set it to less than that.");
  }
  else if (source.distance)
  {
    const double distance = *source.distance;
    require(distance > 0.5 * depth, "The point source is ", distance,
      " data units from the middle of the data, but these reach ", 0.5 * depth,
      " towards it, so it is not in front of them. Set SourceDistance to more than that, or choose "
      "collimated light.");
    const double middleToFilm =
      isFocused ? scene.focusOffset : 0.5 * depth + scene.screenDistance.value_or(depth);
    magnification = 1 + middleToFilm / distance;
    require(magnification > 0, "FocusOffset is ", scene.focusOffset,
      ", so the plane in focus is behind the light source, ", distance,
      " before the middle of the data. Set it to more than ", -distance, ".");
    slope = 0.5 * frame.pixelSize * std::hypot(scene.view.width, scene.view.height) / distance;
  }
  if (source.shape != SourceShape::Point)
  {
    slope += 0.5 * std::hypot(source.width, source.shape == SourceShape::Slit ? source.length : 0) /
      magnification;
  }
  require(slope <= 1, "Light would be inclined to the view by ",
    std::atan(slope) / radiansPerDegree,
    " degrees at the image's corners. Increase SourceDistance or decrease SourceWidth, "
    "SourceLength "
    "or ParallelScale, so that it is no more than 45.");
}

} // namespace

void validate(const Field& field, const Scene& scene)
{
  validate(field.grid);
  require(field.lengthScale > 0 && std::isfinite(field.lengthScale), "LengthScale is ",
    field.lengthScale,
    ", but it is the length of one data unit in metres. Set it to a positive number.");
  validateScene(scene);
  const Frame frame = frameOf(field.grid, scene.view); // which throws where the view is bad
  validateLight(scene, frame);
  const std::string problem =
    scene.lightModel == LightModel::Waves ? problemOfWaves(scene, frame) : "";
  require(problem.empty(), problem);
}

} // namespace schlieren
