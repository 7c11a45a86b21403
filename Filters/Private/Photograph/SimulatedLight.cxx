// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/SimulatedLight.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace filters
{

namespace
{

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double largestOffset = 0.48; // beyond it, there is hardly any light to compare with
constexpr double leastLight = 0.02;    // of undisturbed light behind a cutoff
// Deflection across the main direction over that along it, below which noise and errors of the image settle the angle.
constexpr double leastAcross = 0.02;

double fieldValue(vtkImageData* image, const char* name, double otherwise)
{
  vtkDataArray* array = image->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfTuples() > 0 ? array->GetComponent(0, 0) : otherwise;
}

Plane planeOf(vtkImageData* image, const char* name, int component = 0)
{
  vtkDataArray* array = image->GetPointData()->GetArray(name);
  if (!array || component >= array->GetNumberOfComponents())
  {
    throw std::runtime_error(std::string("The input has no point array ") + name +
      ". The input must be an image of the filter Schlieren, or what has its arrays.");
  }
  Plane plane(image->GetDimensions()[0], image->GetDimensions()[1]);
  for (std::size_t i = 0; i < plane.size(); ++i)
  {
    plane.values[i] = static_cast<float>(array->GetComponent(static_cast<vtkIdType>(i), component));
  }
  return plane;
}

double offsetOf(double parameter) { return largestOffset * std::tanh(parameter); }

} // namespace

SimulatedLight::SimulatedLight(vtkImageData* image)
  : Deflection{ planeOf(image, "Deflection", 0), planeOf(image, "Deflection", 1) }
  , Open(planeOf(image, "BlockedFraction"))
{
  for (float& value : this->Open.values)
  {
    value = 1 - value;
  }
  auto* title =
    vtkStringArray::SafeDownCast(image->GetFieldData()->GetAbstractArray("LegendTitle"));
  const std::string name = title && title->GetNumberOfValues() > 0 ? title->GetValue(0) : "";
  this->KScale = fieldValue(image, "KScale", 0);
  const double undisturbed = fieldValue(image, "UndisturbedLevel", 1);
  const double angle = vtkMath::RadiansFromDegrees(fieldValue(image, "LegendAngle", 0));
  if (!(this->KScale > 0))
  {
  }
  else if (name == "Knife Edge")
  {
    this->Is = Technique::KnifeEdge;
    const double offset = std::clamp(0.5 - undisturbed, -0.47, 0.47);
    this->Start = { std::log(this->KScale / (0.5 - offset)), std::atanh(offset / largestOffset),
      angle };
  }
  else if (name == "Circular" || name == "Circular Complement")
  {
    this->Is = name == "Circular" ? Technique::Circular : Technique::CircularComplement;
    this->Start = { std::log(this->KScale) };
  }
  else if (vtkDataArray* colors = image->GetFieldData()->GetArray("LegendColors");
           colors && name == "Graded Filter")
  {
    this->Is = Technique::GradedFilter;
    for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
    {
      this->Filter.push_back(colors->GetComponent(i, 0) / 255);
    }
    vtkDataArray* range = image->GetFieldData()->GetArray("LegendRange");
    this->Range = { range->GetComponent(0, 0), range->GetComponent(1, 0) };
    this->Start = { 0, angle };
  }
  if (this->Start.size() > 1)
  {
    double uu = 0, uv = 0, vv = 0;
    for (std::size_t i = 0; i < this->Open.size(); ++i)
    {
      if (this->Open.values[i] >= 1)
      {
        const double u = this->Deflection[0].values[i], v = this->Deflection[1].values[i];
        uu += u * u;
        uv += u * v;
        vv += v * v;
      }
    }
    const double half = std::hypot(0.5 * (uu - vv), uv), mean = 0.5 * (uu + vv);
    this->DeflectionAngle = 0.5 * std::atan2(2 * uv, uu - vv);
    this->IsAngleHidden = mean - half <= leastAcross * leastAcross * (mean + half);
  }
  if (this->Is == Technique::Other)
  {
    this->Intensity = planeOf(image, "Intensity");
    for (float& value : this->Intensity.values)
    {
      value /= static_cast<float>(std::max(undisturbed, leastLight));
    }
  }
}

std::vector<SimulatedLight::Parameters> SimulatedLight::starts() const
{
  std::vector<Parameters> all{ this->Start };
  if (this->IsAngleHidden && std::abs(std::cos(this->Start.back() - this->DeflectionAngle)) < 0.1)
  {
    all.front().back() = this->DeflectionAngle;
  }
  const int sides = this->Start.size() < 2 ? 1 : this->IsAngleHidden ? 2 : 4;
  for (int side = 1; side < sides; ++side)
  {
    all.push_back(all.front());
    all.back().back() += side * 2 * vtkMath::Pi() / sides;
  }
  return all;
}

Plane SimulatedLight::light(const Parameters& parameters) const
{
  if (this->Is == Technique::Other)
  {
    return this->Intensity;
  }
  Plane result(this->Open.columns, this->Open.rows);
  const auto& [right, up] = this->Deflection;
  const auto fill = [&](auto&& lightAt)
  {
    for (std::size_t i = 0; i < result.size(); ++i)
    {
      result.values[i] = this->Open.values[i] * lightAt(right.values[i], up.values[i]);
    }
  };
  // Within what single precision holds: a fit may try anything.
  const auto factor = static_cast<float>(std::exp(std::clamp(parameters[0], -60., 60.)));
  if (this->Is == Technique::Circular || this->Is == Technique::CircularComplement)
  {
    const bool isStop = this->Is == Technique::CircularComplement;
    fill(
      [&](float u, float v)
      {
        const float outside = std::min(factor * std::sqrt(u * u + v * v), 1.f);
        return isStop ? outside : 1 - outside;
      });
    return result;
  }
  const auto cosine = static_cast<float>(std::cos(parameters.back()));
  const auto sine = static_cast<float>(std::sin(parameters.back()));
  if (this->Is == Technique::KnifeEdge)
  {
    const float full = static_cast<float>(1 / (0.5 - offsetOf(parameters[1])));
    fill([&](float u, float v)
      { return std::clamp(1 + factor * (cosine * u + sine * v), 0.f, full); });
    return result;
  }
  const double width = this->Range[1] - this->Range[0];
  const int last = static_cast<int>(this->Filter.size()) - 1;
  const auto filterAt = [&](double deflection)
  {
    const double place = std::clamp(
      (deflection - this->Range[0]) / width * (last + 1) - 0.5, 0., static_cast<double>(last));
    const auto index = static_cast<std::size_t>(std::min(static_cast<int>(place), last - 1));
    const double part = place - static_cast<double>(index);
    return (1 - part) * this->Filter[index] + part * this->Filter[index + 1];
  };
  const double undisturbed = std::max(filterAt(0), leastLight);
  fill([&](float u, float v)
    { return static_cast<float>(filterAt(factor * (cosine * u + sine * v)) / undisturbed); });
  return result;
}

std::vector<bool> SimulatedLight::isFull(const Parameters& parameters) const
{
  std::vector<bool> full(this->Open.size(), false);
  if (!this->hasOffset())
  {
    return full;
  }
  const Plane relative = this->light(parameters);
  const double all = 1 / (0.5 - offsetOf(parameters[1]));
  for (std::size_t i = 0; i < full.size(); ++i)
  {
    full[i] = this->Open.values[i] >= 1 && relative.values[i] >= static_cast<float>(all);
  }
  return full;
}

SimulatedLight::Values SimulatedLight::values(const Parameters& parameters) const
{
  if (parameters.empty())
  {
    return { unknown, unknown, unknown, unknown };
  }
  const double factor = std::exp(parameters[0]);
  const auto degrees = [&]
  {
    const double turn = std::fmod(vtkMath::DegreesFromRadians(parameters.back()), 360);
    return turn < 0 ? turn + 360 : turn;
  };
  switch (this->Is)
  {
    case Technique::KnifeEdge:
    {
      const double offset = offsetOf(parameters[1]);
      return { factor, factor * (0.5 - offset), offset, degrees(), this->IsAngleHidden };
    }
    case Technique::GradedFilter:
      return { unknown, factor * this->KScale, unknown, degrees(), this->IsAngleHidden };
    case Technique::Circular:
      return { factor, factor, unknown, unknown };
    default:
      return { unknown, factor, unknown, unknown };
  }
}

} // namespace filters
