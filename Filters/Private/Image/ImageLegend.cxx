// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/ImageLegend.h"

#include "Image/FieldData.h"
#include "Image/ImageStatus.h"
#include "Image/RealOptics.h"
#include "NumberText.h"
#include "SchlierenSettings.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include "Schlieren.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace filters
{

namespace
{

using Quantity = schlieren::Legend::Quantity;

/// Returns where a deflection along an edge's normal goes, as it is seen in the image.
std::string directionInWords(double degrees)
{
  const double turn = std::remainder(degrees, 360.);
  return turn == 0           ? "to the right"
    : turn == 90             ? "up"
    : turn == -90            ? "down"
    : std::abs(turn) == 180. ? "to the left"
                             : "along " + textOf(turn, 4) + " degrees";
}

/// Returns what the legend's values are, and sets their unit, which has no prefix.
std::string labelOf(
  const schlieren::Legend& legend, const schlieren::Scene& scene, std::string& unit)
{
  switch (legend.quantity)
  {
    case Quantity::Deflection:
      unit = "rad";
      return "deflection " + directionInWords(scene.knifeEdgeAngle);
    case Quantity::DeflectionSize:
      unit = "rad";
      return "deflection";
    case Quantity::DeflectionPlane:
      unit = "rad";
      return "deflection to the right and up";
    case Quantity::Light:
      return "light (undisturbed: 1)";
    case Quantity::Path:
      return "optical path in wavelengths of " +
        textOf("%.4g nm", scene.wavelength / metresPerNanometre);
    case Quantity::None:
      break;
  }
  return "";
}

/// Returns the lines below the scale.
std::vector<std::string> notesOn(const SchlierenSettings& settings, const schlieren::Scene& scene,
  const schlieren::Image& image, bool isKept)
{
  std::vector<std::string> notes;
  if (usesK(settings) && image.kScale > 0)
  {
    notes.push_back(kInWords(image.kScale, false) +
      (isKept                  ? " (kept)"
          : choosesK(settings) ? " (automatic)"
                               : " (fixed)"));
    notes.push_back(weaknessInWords(settings, image.kScale));
  }
  if (schlieren::techniqueOf(scene.cutoff).plane == schlieren::RecordedPlane::Screen)
  {
    const double metres = settings.LengthScale * image.screenDistance;
    notes.push_back("screen " + lengthInWords(metres, 3) + " behind the data" +
      (isKept                    ? " (kept)"
          : scene.choosesScreen  ? " (automatic)"
          : scene.screenDistance ? ""
                                 : " (one depth)"));
  }
  if (!image.backgroundDisplacement.empty())
  {
    notes.push_back("pattern displaced by up to " +
      textOf("%.3g pixels", largestLength(image.backgroundDisplacement) / image.patternPixel));
  }
  if (image.accuracy.target > 0)
  {
    notes.push_back(errorInWords(image.accuracy, scene));
  }
  notes.erase(std::remove(notes.begin(), notes.end(), ""), notes.end());
  return notes;
}

} // namespace

void addLegend(vtkImageData* output, const SchlierenSettings& settings,
  const schlieren::Scene& scene, const schlieren::Image& image, bool isKept, ColorScale colors)
{
  const schlieren::Legend legend = schlieren::legendOf(scene, image.kScale);
  std::string unit;
  const std::string label = labelOf(legend, scene, unit);
  const bool areWavelengths = legend.quantity == Quantity::Path && unit.empty();
  const double scale = areWavelengths ? 1 / scene.wavelength : 1;

  addFieldValue<vtkStringArray>(
    output, "LegendTitle", std::string(schlieren::techniqueOf(scene.cutoff).name));
  addFieldValues<vtkStringArray>(output, "LegendLabel", std::vector<std::string>{ label, unit });
  const std::vector<std::string> notes = notesOn(settings, scene, image, isKept);
  if (!notes.empty()) // scripts read the first value of each array
  {
    addFieldValues<vtkStringArray>(output, "LegendNotes", notes);
  }
  addFieldValues<vtkDoubleArray>(
    output, "LegendRange", std::array<double, 2>{ scale * legend.lowest, scale * legend.highest });
  addFieldValues<vtkIntArray>(
    output, "LegendSize", std::array<int, 2>{ legend.width, legend.height });
  if (!legend.light.empty())
  {
    std::vector<unsigned char> bytes;
    for (const float light : legend.light)
    {
      bytes.push_back(byteOf(light, colors));
    }
    addFieldValues<vtkUnsignedCharArray>(output, "LegendColors", bytes, 3);
  }
  addFieldValue<vtkDoubleArray>(
    output, "WhiteLevel", colors == ColorScale::LinearToTwice ? 2. : 1.);
  addFieldValue<vtkDoubleArray>(output, "LengthScale", settings.LengthScale);
  if (legend.quantity == Quantity::Deflection)
  {
    addFieldValue<vtkDoubleArray>(output, "LegendAngle", scene.knifeEdgeAngle);
  }
}

} // namespace filters
