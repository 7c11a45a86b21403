// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/SimulatedLight.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <Eigen/Core>

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
constexpr double fullContrast = 4;     // artanh 0.9993, of fringes that are dark in their middle
constexpr double leastFringes = 0.25;  // in an image; fewer look like an uneven lamp
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

/// Less contrast than none is a phase half a fringe further on.
Fringes fringesOf(const SimulatedLight::Parameters& parameters)
{
  const double contrast = std::tanh(parameters[0]);
  return { std::abs(contrast), parameters[1] + (contrast < 0 ? vtkMath::Pi() : 0),
    { parameters[2], parameters[3] } };
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
  const double wavelength = fieldValue(image, "Wavelength", 0);
  if (name == "Interferogram" && wavelength > 0)
  {
    this->Is = Technique::Interferogram;
    vtkDataArray* path = image->GetPointData()->GetArray("OpticalPathDifference");
    this->Turns = planeOf(image, "OpticalPathDifference");
    for (std::size_t i = 0; i < this->Turns.size(); ++i)
    {
      const double turns = path->GetComponent(static_cast<vtkIdType>(i), 0) / wavelength;
      this->Turns.values[i] =
        std::isfinite(turns) ? static_cast<float>(std::remainder(turns, 1)) : 0.f;
    }
    this->HalfSize = { 0.5 * image->GetSpacing()[0] * (this->Turns.columns - 1),
      0.5 * image->GetSpacing()[1] * (this->Turns.rows - 1) };
    const double spacing = fieldValue(image, "FringeSpacing", HUGE_VAL);
    const double turn = vtkMath::RadiansFromDegrees(fieldValue(image, "FringeAngle", 0));
    this->Start = { fullContrast, 0,
      2 * vtkMath::Pi() * this->HalfSize[0] / spacing * std::cos(turn),
      2 * vtkMath::Pi() * this->HalfSize[1] / spacing * std::sin(turn) };
    return;
  }
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
  else if (name == "Bright Field" || name == "Dark Field")
  {
    this->Is = name == "Bright Field" ? Technique::BrightField : Technique::DarkField;
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

std::vector<SimulatedLight::Parameters> SimulatedLight::starts(
  const Plane& seen, const Plane& withoutFlow, const Plane& known) const
{
  std::vector<Parameters> all{ this->Start };
  if (this->hasFringes())
  {
    Plane weight = known;
    for (std::size_t i = 0; i < weight.size(); ++i)
    {
      weight.values[i] *= this->Open.values[i];
    }
    for (const Fringes& one : findFringes(seen, weight, this->Turns, withoutFlow))
    {
      all.push_back(
        { std::atanh(std::clamp(one.contrast, 0.1, 0.9)), one.phase, one.tilt[0], one.tilt[1] });
    }
    all.front()[0] = all[1][0];
    return all;
  }
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
  if (this->Is == Technique::Interferogram)
  {
    const Fringes fringes = fringesOf(parameters);
    const auto contrast = static_cast<float>(fringes.contrast);
    const auto step = static_cast<float>(2 * fringes.tilt[0] / std::max(1, result.columns - 1));
    const Eigen::ArrayXf along =
      Eigen::ArrayXf::LinSpaced(result.columns, 0, static_cast<float>(result.columns - 1)) * step;
    for (int row = 0; row < result.rows; ++row)
    {
      const std::size_t first = result.index(0, row);
      const Eigen::Map<const Eigen::ArrayXf> turns(&this->Turns.values[first], result.columns);
      const Eigen::Map<const Eigen::ArrayXf> open(&this->Open.values[first], result.columns);
      const auto begin = static_cast<float>(fringes.phaseAt(-1, coordinate(row, result.rows)));
      constexpr auto turn = static_cast<float>(2 * vtkMath::Pi());
      Eigen::Map<Eigen::ArrayXf>(&result.values[first], result.columns) =
        open * (1 + contrast * (turn * turns + along + begin).cos()) / (1 + contrast);
    }
    return result;
  }
  // Within what single precision holds: a fit may try anything.
  const auto factor = static_cast<float>(std::exp(std::clamp(parameters[0], -60., 60.)));
  if (this->Is == Technique::BrightField || this->Is == Technique::DarkField)
  {
    const bool isStop = this->Is == Technique::DarkField;
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

SimulatedLight::Parameters SimulatedLight::mirrored(const Parameters& ofFringes)
{
  return { ofFringes[0], -ofFringes[1], -ofFringes[2], -ofFringes[3] };
}

bool SimulatedLight::areSame(const Parameters& ofFringes, const Parameters& others)
{
  constexpr double least = 0.3; // radians: less is not another minimum
  const Fringes one = fringesOf(ofFringes), other = fringesOf(others);
  return std::abs(one.tilt[0] - other.tilt[0]) < least &&
    std::abs(one.tilt[1] - other.tilt[1]) < least &&
    std::abs(std::remainder(one.phase - other.phase, 2 * vtkMath::Pi())) < least;
}

SimulatedLight::Parameters SimulatedLight::withoutContrast(const Parameters& ofFringes)
{
  return { 0, ofFringes[1], ofFringes[2], ofFringes[3] };
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
  const auto within = [](double value, double period)
  { return value - period * std::floor(value / period); };
  const auto degrees = [&] { return within(vtkMath::DegreesFromRadians(parameters.back()), 360); };
  switch (this->Is)
  {
    case Technique::KnifeEdge:
    {
      const double offset = offsetOf(parameters[1]);
      return { factor, factor * (0.5 - offset), offset, degrees(), this->IsAngleHidden };
    }
    case Technique::GradedFilter:
      return { unknown, factor * this->KScale, unknown, degrees(), this->IsAngleHidden };
    case Technique::Interferogram:
    {
      const Fringes fringes = fringesOf(parameters);
      // Radians per data unit; along an axis of one point there is no tilt.
      const auto slope = [&](std::size_t axis)
      { return this->HalfSize[axis] > 0 ? fringes.tilt[axis] / this->HalfSize[axis] : 0; };
      const double right = slope(0), up = slope(1);
      const double fringesInImage = std::hypot(fringes.tilt[0], fringes.tilt[1]) / vtkMath::Pi();
      const double spacing =
        fringesInImage < leastFringes ? 0 : 2 * vtkMath::Pi() / std::hypot(right, up);
      return { unknown, unknown, unknown, unknown, false, fringes.contrast,
        within(fringes.phase / (2 * vtkMath::Pi()), 1), spacing,
        within(vtkMath::DegreesFromRadians(std::atan2(up, right)), 360) };
    }
    case Technique::BrightField:
      return { factor, factor, unknown, unknown };
    default:
      return { unknown, factor, unknown, unknown };
  }
}

} // namespace filters
