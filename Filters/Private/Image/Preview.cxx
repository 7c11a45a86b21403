// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/Preview.h"

#include "Settings/QualityPresets.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace filters
{

int previewPixels(int pixels, int reduction)
{
  return std::max(1, static_cast<int>(std::lround(static_cast<double>(pixels) / reduction)));
}

schlieren::View previewView(
  const schlieren::View& view, const schlieren::Frame& frame, int reduction)
{
  schlieren::View preview = view;
  preview.width = previewPixels(view.width, reduction);
  preview.height = previewPixels(view.height, reduction);
  const double larger = std::max(static_cast<double>(view.width) / preview.width,
    static_cast<double>(view.height) / preview.height);
  preview.parallelScale = 0.5 * preview.height * larger * frame.pixelSize;
  if (frame.pupil > 0)
  {
    preview.viewAngle =
      vtkMath::DegreesFromRadians(2 * std::atan(preview.parallelScale / frame.pupil));
  }
  return preview;
}

int reductionAtFirst(const schlieren::View& view)
{
  constexpr int pixels = 64;
  return std::max(2, (std::max(view.width, view.height) + pixels - 1) / pixels);
}

void makePreview(schlieren::Scene& scene, const schlieren::Frame& frame, int reduction)
{
  constexpr double fewestPerPeriod = 4; // finer periods fade to grey
  const schlieren::View whole = scene.view;
  scene.view = previewView(whole, frame, reduction);
  // Keeps the pattern's size, where that is one of the image's pixels.
  const double larger = std::max(static_cast<double>(whole.width) / scene.view.width,
    static_cast<double>(whole.height) / scene.view.height);
  scene.background.pixelsPerPeriod =
    std::max(scene.background.pixelsPerPeriod, fewestPerPeriod * reduction) / larger;
  scene.targetError = 0;
  scene.lightModel = schlieren::LightModel::Rays; // waves take as many points for fewer pixels
  scene.samplesPerPixel = std::min(scene.samplesPerPixel, 1); // keeps invalid values
  scene.samplesAtEdges = 0;
  scene.stepSize = std::max(scene.stepSize, interactiveStepSize());
  scene.smoothingRadius /= reduction;
}

} // namespace filters
