// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/SceneFromSettings.h"
#include "Common/AvailableMemory.h"
#include "Common/Threads.h"

#include "Gas/GasChoices.h"
#include "Image/Preview.h"
#include "Image/RealOptics.h"
#include "Image/RgbImages.h"
#include "SchlierenSettings.h"

#include "vtkPiecewiseFunction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace filters
{

namespace
{

/// Number of samples of a graded filter's curve.
constexpr int gradedFilterSamples = 1025;

/// A quarter of what is free, as all else of an image wants memory, too.
std::size_t memoryForWaves()
{
  constexpr double part = 0.25, most = 1e15;
  return static_cast<std::size_t>(std::min(part * availableMemory(), most));
}

schlieren::Fringes fringesFrom(
  const SchlierenSettings& settings, const schlieren::Frame& frame, int height)
{
  schlieren::Fringes fringes;
  fringes.finite = settings.FringeSpacing != 0;
  if (fringes.finite)
  {
    fringes.spacing = fringeSpacingFrom(settings, frame, height);
    fringes.angle = settings.FringeAngle;
  }
  return fringes;
}

schlieren::BackgroundPattern backgroundFrom(
  const SchlierenSettings& settings, RgbImageReader& images)
{
  schlieren::BackgroundPattern pattern;
  pattern.kind = static_cast<schlieren::PatternKind>(settings.BackgroundPattern);
  if (!(settings.BackgroundDistance < 0))
  {
    pattern.distance = settings.BackgroundDistance;
  }
  pattern.period = settings.BackgroundPeriod;
  pattern.angle = settings.FringeAngle;
  if (pattern.kind == schlieren::PatternKind::Image)
  {
    if (settings.BackgroundImage.empty())
    {
      throw std::runtime_error(
        "BackgroundImage is empty, so there is no image behind the flow. Give "
        "the name of one, or set BackgroundPattern to Dots or Stripes.");
    }
    pattern.image = images.read("BackgroundImage", settings.BackgroundImage);
  }
  return pattern;
}

/// Returns the width by the height of the data's box as it is seen; of what is longer than that, 8 or 1/8.
double proportionsOf(const schlieren::Grid& grid, const schlieren::Frame& frame)
{
  constexpr double longest = 8;
  const auto extentAlong = [&](const schlieren::Vector& direction)
  {
    double extent = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double along = 0;
      for (std::size_t row = 0; row < 3; ++row)
      {
        along += direction[row] * grid.direction[3 * row + axis];
      }
      extent +=
        std::abs(along) * grid.spacing[axis] * static_cast<double>(grid.dimensions[axis] - 1);
    }
    return extent;
  };
  const double width = extentAlong(frame.u), height = extentAlong(frame.v);
  return width > 0 || height > 0 ? std::clamp(width / height, 1 / longest, longest) : 1;
}

/// Returns the view of the full image.
schlieren::View viewFrom(const SchlierenSettings& settings, const schlieren::Grid& grid)
{
  schlieren::View view;
  std::copy_n(settings.ViewDirection, 3, view.viewDirection.begin());
  std::copy_n(settings.ViewUp, 3, view.viewUp.begin());
  if (settings.HasFocalPoint)
  {
    const double* point = settings.FocalPoint;
    view.focalPoint = schlieren::Vector{ point[0], point[1], point[2] };
  }
  view.parallelScale = settings.ParallelScale;
  view.viewAngle = settings.ViewAngle;
  const auto& [width, height] = settings.ImageSize;
  if (width == 0 || height == 0)
  {
    const double ratio = proportionsOf(grid, schlieren::frameOf(grid, view));
    const auto side = [](double pixels) { return static_cast<int>(std::lround(pixels)); };
    view.height = height != 0 ? height
      : width != 0            ? side(width / ratio)
                              : side(view.height / std::sqrt(ratio));
    view.width = width != 0 ? width
      : height != 0         ? side(height * ratio)
                            : side(view.width * std::sqrt(ratio));
  }
  else
  {
    view.width = width;
    view.height = height;
  }
  view.viewAngle = viewAngleFrom(settings, view, grid);
  return view;
}

/// Returns whether the default view direction lies in the plane of flat data.
bool looksAlong(const ViewSettings& settings, int flatAxis)
{
  const ViewSettings byDefault;
  return settings.FaceFlatData && (flatAxis == 0 || flatAxis == 1) &&
    std::equal(settings.ViewDirection, settings.ViewDirection + 3, byDefault.ViewDirection);
}

} // namespace

std::vector<double> gradedFilterFrom(vtkPiecewiseFunction* function)
{
  if (!function || function->GetSize() == 0)
  {
    return { 0, 1 };
  }
  std::vector<double> values(gradedFilterSamples);
  function->GetTable(0, 1, gradedFilterSamples, values.data());
  return values;
}

schlieren::LightModel lightModelOf(const SchlierenSettings& settings)
{
  return settings.Cutoff == static_cast<int>(schlieren::Cutoff::PhaseContrast)
    ? schlieren::LightModel::Waves
    : static_cast<schlieren::LightModel>(settings.LightModel);
}

SchlierenSettings facing(SchlierenSettings settings, int flatAxis)
{
  if (looksAlong(settings, flatAxis))
  {
    // Turns z up, and x or y to the right.
    const double across[2][3] = { { -1, 0, 0 }, { 0, 1, 0 } };
    std::copy_n(across[flatAxis], 3, settings.ViewDirection);
    const ViewSettings byDefault;
    if (std::equal(settings.ViewUp, settings.ViewUp + 3, byDefault.ViewUp))
    {
      const double z[3] = { 0, 0, 1 };
      std::copy_n(z, 3, settings.ViewUp);
    }
  }
  return settings;
}

std::string noteOnView(const SchlierenSettings& settings, int flatAxis)
{
  return looksAlong(settings, flatAxis)
    ? std::string(" ViewDirection (0, 0, -1) is along their plane: the image is as seen along ") +
      (flatAxis == 0 ? "(-1, 0, 0)" : "(0, 1, 0)") + ", onto it."
    : "";
}

std::array<int, 2> imageSizeFrom(const SchlierenSettings& settings, const schlieren::Grid& grid)
{
  const schlieren::View view = viewFrom(settings, grid);
  return { view.width, view.height };
}

schlieren::Frame frameFrom(const SchlierenSettings& settings, const schlieren::Grid& grid)
{
  const schlieren::View view = viewFrom(settings, grid);
  const schlieren::Frame frame = schlieren::frameOf(grid, view);
  const int reduction = settings.PreviewReduction;
  return reduction > 1 ? schlieren::frameOf(grid, previewView(view, frame, reduction)) : frame;
}

schlieren::Scene sceneFrom(
  const SchlierenSettings& settings, const schlieren::Grid& grid, RgbImageReader& images)
{
  schlieren::Scene scene;
  scene.view = viewFrom(settings, grid);
  const schlieren::Frame frame = schlieren::frameOf(grid, scene.view);
  scene.source = lightSourceFrom(settings);
  scene.lens = lensFrom(settings);
  scene.cutoff = static_cast<schlieren::Cutoff>(settings.Cutoff);
  scene.knifeEdgeAngle = settings.KnifeEdgeAngle;
  // Skips k where the cutoff does not use it, because it may be invalid then.
  if (usesK(settings))
  {
    setSensitivity(settings, scene);
  }
  if (scene.cutoff == schlieren::Cutoff::ColorFilter && !settings.ColorFilterImage.empty())
  {
    scene.colorFilter = images.read("ColorFilterImage", settings.ColorFilterImage);
  }
  scene.lightModel = lightModelOf(settings);
  const bool hasFringes = schlieren::techniqueOf(scene.cutoff).hasFringes;
  if (hasFringes || scene.lightModel != schlieren::LightModel::Rays)
  {
    scene.wavelength = metresPerNanometre * settings.Wavelength;
  }
  if (scene.lightModel != schlieren::LightModel::Rays)
  {
    scene.memoryBudget = std::max(scene.memoryBudget, memoryForWaves());
  }
  if (scene.cutoff == schlieren::Cutoff::PhaseContrast)
  {
    scene.phasePlate = phasePlateFrom(settings);
  }
  if (hasFringes)
  {
    scene.fringes = fringesFrom(settings, frame, scene.view.height);
  }
  if (schlieren::isOfCamera(scene.cutoff))
  {
    scene.background = backgroundFrom(settings, images);
  }
  if (!(settings.ScreenDistance < 0)) // accepts NaN, which the tracer reports
  {
    scene.screenDistance = settings.ScreenDistance;
  }
  // Waves need pixels and memory as the distance is: theirs is one depth, which a bench has, too.
  scene.choosesScreen =
    settings.ScreenDistance < 0 && scene.lightModel == schlieren::LightModel::Rays;
  scene.focusOffset = settings.FocusOffset;
  scene.exitInto = static_cast<schlieren::ExitInto>(settings.ExitInto);
  scene.exitRefractivity = settings.ExitRefractivity;
  scene.smoothingRadius = settings.SmoothingRadius;
  scene.histogramSize = histogramBins;
  scene.samplesPerPixel = settings.SamplesPerPixel;
  scene.pathModel = static_cast<schlieren::PathModel>(settings.PathModel);
  scene.stepSize = settings.StepSize;
  scene.precision = static_cast<schlieren::Precision>(settings.Precision);
  scene.mediumTolerance = settings.MediumTolerance;
  scene.targetError = settings.TargetError < 0
    ? schlieren::unseenError(schlieren::techniqueOf(scene.cutoff))
    : settings.TargetError;
  const bool hasTarget = scene.targetError > 0;
  // The light of pixels at edges errs by about one over their rays, that of others by much less.
  constexpr int fewestOfExact = 16, mostOfExact = 255, moreAtEdges = 4;
  const bool hasMoreAtEdges = !hasTarget && scene.lightModel == schlieren::LightModel::Rays &&
    scene.samplesPerPixel >= fewestOfExact && scene.samplesPerPixel <= mostOfExact;
  scene.samplesAtEdges = hasMoreAtEdges ? moreAtEdges * scene.samplesPerPixel : 0;
  // Longer steps hide what cubic splines gain.
  constexpr double longestOfCubic = 1;
  scene.interpolation = hasTarget || scene.stepSize <= longestOfCubic
    ? schlieren::Interpolation::Cubic
    : schlieren::Interpolation::Quadratic;
  // A target error chooses steps itself; waves take so many rays that a longer time for each counts.
  const bool areExact = scene.precision == schlieren::Precision::Double &&
    scene.lightModel == schlieren::LightModel::Rays;
  scene.integrator =
    !hasTarget && areExact ? schlieren::Integrator::Adaptive : schlieren::Integrator::Leapfrog;
  scene.mediumMemory = static_cast<std::size_t>(settings.MediumMemory) << 20;
  scene.device = static_cast<schlieren::Device>(settings.Device);
  scene.threads = threadsFrom(settings.NumberOfThreads);
  if (settings.PreviewReduction > 1)
  {
    makePreview(scene, frame, settings.PreviewReduction);
  }
  return scene;
}

} // namespace filters
