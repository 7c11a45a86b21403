// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/PixelInWords.h"

#include "NumberText.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace filters
{

namespace
{

double fieldValue(vtkImageData* image, const char* name, int component)
{
  vtkDataArray* array = image->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfValues() > component
    ? array->GetVariantValue(component).ToDouble()
    : 0;
}

/// Returns values with a unit whose prefix suits the largest of them.
std::string inWords(std::initializer_list<double> values, const char* unit)
{
  double largest = 0;
  for (const double value : values)
  {
    largest = std::max(largest, std::abs(value));
  }
  const UnitPrefix prefix = unitPrefixOf(largest);
  std::string text;
  for (const double value : values)
  {
    text += (text.empty() ? "" : ", ") + textOf(value / prefix.factor, 4);
  }
  return text + " " + prefix.name + unit;
}

/// Returns the name of a direction in the data, if it is along an axis.
std::string axisName(vtkImageData* image, const char* direction, const char* otherwise)
{
  constexpr double rounding = 1e-9;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double part = fieldValue(image, direction, axis);
    if (std::abs(part) > 1 - rounding)
    {
      return (part < 0 ? "-" : "") + std::string(1, "xyz"[axis]);
    }
  }
  return otherwise;
}

std::string shiftInWords(double right, double up)
{
  const double length = std::hypot(right, up);
  const auto part = [&](double shift, const char* forwards, const char* backwards)
  {
    constexpr double least = 0.3; // of the length, to be named
    return std::abs(shift) < least * length
      ? ""
      : lengthInWords(std::abs(shift), 3) + (shift > 0 ? forwards : backwards);
  };
  const std::string across = part(right, " to the right", " to the left");
  const std::string along = part(up, " up", " down");
  return across + (across.empty() || along.empty() ? "" : ", ") + along;
}

} // namespace

std::string pixelInWords(vtkImageData* image, double right, double up)
{
  const int* size = image->GetDimensions();
  if (!(right >= 0 && right < 1 && up >= 0 && up < 1) || image->GetNumberOfPoints() == 0)
  {
    return "";
  }
  const auto column = static_cast<vtkIdType>(right * size[0]),
             row = static_cast<vtkIdType>(up * size[1]);
  const vtkIdType pixel = row * size[0] + column;
  const auto valueOf = [&](const char* name, int component)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(name);
    return array ? array->GetComponent(pixel, component) : 0;
  };
  const double scale = fieldValue(image, "LengthScale", 0);
  double place[3];
  image->GetPoint(pixel, place);
  std::string text = axisName(image, "AxisRight", "u") + ", " + axisName(image, "AxisUp", "v") +
    ": " + inWords({ scale * place[0], scale * place[1] }, "m");
  if (valueOf("BlockedFraction", 0) >= 1)
  {
    return text + "\nLight is blocked";
  }
  text += "\nDeflection to the right, up: " +
    inWords({ valueOf("Deflection", 0), valueOf("Deflection", 1) }, "rad");
  text += "\nOptical path difference: " + inWords({ valueOf("OpticalPathDifference", 0) }, "m");
  text += "\nIntensity: " + textOf(valueOf("Intensity", 0), 3);
  if (!image->GetPointData()->GetArray("Photograph"))
  {
    return text;
  }
  const double photograph = valueOf("Photograph", 0);
  if (!std::isfinite(photograph))
  {
    return "Beyond the photograph\n" + text;
  }
  const double shift[] = { scale * valueOf("FeatureShift", 0), scale * valueOf("FeatureShift", 1) };
  const bool isFeature = std::isfinite(shift[0]) && std::hypot(shift[0], shift[1]) > 0;
  return (isFeature ? "The photograph's feature lies " + shiftInWords(shift[0], shift[1]) + "; "
                    : std::string()) +
    "photograph " + textOf(photograph, 2) + ", simulated " + textOf(valueOf("Simulated", 0), 2) +
    "\n" + text;
}

} // namespace filters
