// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/ImageLegend.h"

#include "Image/ImageStatus.h"
#include "Image/RealOptics.h"
#include "SchlierenSettings.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include "Schlieren.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace filters
{

namespace
{

using Quantity = schlieren::Legend::Quantity;

template <class Number>
std::string textOf(const char* format, Number value)
{
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Returns where a deflection along an edge's normal goes, as it is seen in the image.
std::string directionInWords(double degrees)
{
  const double turn = std::remainder(degrees, 360.);
  return turn == 0           ? "to the right"
    : turn == 90             ? "up"
    : turn == -90            ? "down"
    : std::abs(turn) == 180. ? "to the left"
                             : "along " + textOf("%.4g", turn) + " degrees";
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
      if (scene.fringes.whiteLight)
      {
        unit = "m";
        return "optical path";
      }
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
    const bool isAutomatic = choosesK(settings) && !isKept;
    notes.push_back(kInWords(image.kScale, isKept) + (isAutomatic ? " (automatic)" : ""));
  }
  if (!image.backgroundDisplacement.empty())
  {
    double largest = 0;
    for (std::size_t i = 0; i + 1 < image.backgroundDisplacement.size(); i += 2)
    {
      const double u = image.backgroundDisplacement[i], v = image.backgroundDisplacement[i + 1];
      largest = std::max(largest, u * u + v * v);
    }
    notes.push_back("pattern displaced by up to " +
      textOf("%.3g pixels", std::sqrt(largest) / image.frame.pixelSize));
  }
  if (image.accuracy.target > 0)
  {
    notes.push_back(errorInWords(image.accuracy, scene));
  }
  return notes;
}

void addTexts(vtkFieldData* data, const char* name, const std::vector<std::string>& texts)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts)
  {
    array->InsertNextValue(text);
  }
  data->AddArray(array);
}

void addNumber(vtkFieldData* data, const char* name, double number)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(number);
  data->AddArray(array);
}

} // namespace

//------------------------------------------------------------------------------
void addLegend(vtkImageData* output, const SchlierenSettings& settings,
  const schlieren::Scene& scene, const schlieren::Image& image, bool isKept, bool isDifference,
  ColorScale colors)
{
  const schlieren::Legend legend =
    isDifference ? schlieren::Legend{} : schlieren::legendOf(scene, image.kScale);
  std::string unit;
  const std::string label =
    isDifference ? "refracted less straight rays" : labelOf(legend, scene, unit);
  const bool areWavelengths = legend.quantity == Quantity::Path && unit.empty();
  const double scale = areWavelengths ? 1 / scene.wavelength : 1;

  vtkFieldData* data = output->GetFieldData();
  addTexts(data, "LegendTitle", { schlieren::techniqueOf(scene.cutoff).name });
  addTexts(data, "LegendLabel", { label, unit });
  const std::vector<std::string> notes = notesOn(settings, scene, image, isKept);
  if (!notes.empty()) // scripts read the first value of each array
  {
    addTexts(data, "LegendNotes", notes);
  }
  vtkNew<vtkDoubleArray> range;
  range->SetName("LegendRange");
  range->InsertNextValue(scale * legend.lowest);
  range->InsertNextValue(scale * legend.highest);
  data->AddArray(range);
  vtkNew<vtkIntArray> size;
  size->SetName("LegendSize");
  size->InsertNextValue(legend.width);
  size->InsertNextValue(legend.height);
  data->AddArray(size);
  if (!legend.light.empty())
  {
    vtkNew<vtkUnsignedCharArray> bytes;
    bytes->SetName("LegendColors");
    bytes->SetNumberOfComponents(3);
    for (const float light : legend.light)
    {
      bytes->InsertNextValue(byteOf(light, colors));
    }
    data->AddArray(bytes);
  }
  addNumber(data, "LengthScale", settings.LengthScale);
  if (legend.quantity == Quantity::Deflection)
  {
    addNumber(data, "LegendAngle", scene.knifeEdgeAngle);
  }
}

} // namespace filters
