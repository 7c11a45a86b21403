// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filter/SchlierenFilterInternals.h"

#include "Image/PixelInWords.h"
#include "Image/RealOptics.h"
#include "Settings/QualityPresets.h"

#include "vtkBoundingBox.h"
#include "vtkMath.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <string>
#include <type_traits>

using namespace filters;

namespace
{

/// One that has nothing for numbers that are no cutoff.
schlieren::Technique techniqueOf(int cutoff)
{
  return cutoff >= 0 && static_cast<std::size_t>(cutoff) < schlieren::techniques.size()
    ? schlieren::techniqueOf(static_cast<schlieren::Cutoff>(cutoff))
    : schlieren::Technique{};
}

/// Nothing for what has not been measured.
QualityError errorOf(int quality)
{
  const auto index = static_cast<std::size_t>(quality);
  return index < qualityErrors.size() ? qualityErrors[index] : QualityError{};
}

template <class Value>
void print(ostream& os, const Value& value)
{
  if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, std::string>)
  {
    os << " " << value;
  }
  else
  {
    for (const auto& number : value)
    {
      os << " " << number;
    }
  }
}

} // namespace

void vtkSchlierenFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  SchlierenSettings::visit(
    [&](const char* name, auto member)
    {
      os << indent << name << ":";
      print(os, this->*member);
      os << "\n";
    });
  os << indent << "GradedFilter: " << this->GradedFilter << "\n";
  os << indent << "Quality: " << this->GetQuality() << "\n";
  os << indent << "LockedAmbient: " << this->GetLockedAmbient() << "\n";
  os << indent << "LockedDepth: " << this->GetLockedDepth() << "\n";
  os << indent << "LockedK: " << this->GetLockedK() << "\n";
  os << indent << "KScaleUsed: " << this->KScaleUsed << "\n";
  os << indent << "AutomaticUsed: " << this->AutomaticUsed << "\n";
  os << indent << "Sensitivity: " << this->Sensitivity << "\n";
  os << indent << "Finished: " << this->GetFinished() << "\n";
  os << indent << "ImageCount: " << this->ImageCount << "\n";
  os << indent << "Status: " << this->Status << "\n";
  os << indent << "Grid: " << this->GetGrid() << "\n";
  os << indent << "MediumBuilds: " << this->GetMediumBuilds() << "\n";
  os << indent << "TotalRaysTraced: " << this->GetTotalRaysTraced() << "\n";
}

void vtkSchlierenFilter::SetFocalPoint(double x, double y, double z)
{
  const double point[3] = { x, y, z };
  if (!this->HasFocalPoint || !std::equal(point, point + 3, this->FocalPoint))
  {
    std::copy(point, point + 3, this->FocalPoint);
    this->HasFocalPoint = true;
    this->Modified();
  }
}

void vtkSchlierenFilter::ClearFocalPoint()
{
  if (this->HasFocalPoint)
  {
    std::fill_n(this->FocalPoint, 3, 0.);
    this->HasFocalPoint = false;
    this->Modified();
  }
}

void vtkSchlierenFilter::SetGradedFilter(vtkPiecewiseFunction* function)
{
  if (this->GradedFilter != function)
  {
    this->GradedFilter = function;
    this->Modified();
  }
}

vtkPiecewiseFunction* vtkSchlierenFilter::GetGradedFilter() const { return this->GradedFilter; }

void vtkSchlierenFilter::SetWavelength(double wavelength)
{
  this->SchlierenSettings::Wavelength = wavelength;
  this->Superclass::SetWavelength(wavelength);
}

void vtkSchlierenFilter::SetCutoff(int cutoff)
{
  cutoff = std::clamp(cutoff, 0, static_cast<int>(schlieren::techniques.size()) - 1);
  if (this->Cutoff != cutoff)
  {
    this->Cutoff = cutoff;
    this->AutomaticUsed = 0; // until there is an image of this technique
    this->Modified();
  }
}

bool vtkSchlierenFilter::CutoffHasK(int cutoff) { return techniqueOf(cutoff).hasK(); }

bool vtkSchlierenFilter::CutoffHasEdge(int cutoff) { return techniqueOf(cutoff).hasEdge; }

bool vtkSchlierenFilter::CutoffHasFringes(int cutoff) { return techniqueOf(cutoff).hasFringes; }

bool vtkSchlierenFilter::CutoffHasScreen(int cutoff)
{
  return techniqueOf(cutoff).plane == schlieren::RecordedPlane::Screen;
}

double vtkSchlierenFilter::CutoffWhite(int cutoff)
{
  return CutoffHasScreen(cutoff) || cutoff == PHASE_CONTRAST ? 2 : 1;
}

bool vtkSchlierenFilter::CutoffHasBackground(int cutoff)
{
  return techniqueOf(cutoff).plane == schlieren::RecordedPlane::Background;
}

bool vtkSchlierenFilter::CutoffHasColor(int cutoff, int backgroundPattern)
{
  const schlieren::Coloring coloring = techniqueOf(cutoff).coloring;
  return coloring == schlieren::Coloring::Always ||
    (coloring == schlieren::Coloring::OfBackgroundImage && backgroundPattern == PICTURE);
}

void vtkSchlierenFilter::SetPupil(double diameter, double focusDistance)
{
  schlieren::Lens& pupil = this->Inside->Pupil;
  if (pupil.aperture != diameter || pupil.focusDistance != focusDistance)
  {
    pupil.aperture = diameter;
    pupil.focusDistance = focusDistance;
    this->Modified();
  }
}

bool vtkSchlierenFilter::HasOwnColor() const
{
  return CutoffHasColor(this->Cutoff, this->BackgroundPattern);
}

void vtkSchlierenFilter::SetQuality(int quality)
{
  if (quality < INTERACTIVE || quality >= CUSTOM)
  {
    return;
  }
  AccuracySettings preset;
  for (const QualitySetting& setting : qualitySettings)
  {
    setting.Set(preset, setting.Values[static_cast<std::size_t>(quality)]);
  }
  this->SetPrecision(preset.Precision); // the medium's, too
  if (this->GetQuality() != quality)
  {
    static_cast<AccuracySettings&>(*this) = preset;
    this->Modified();
  }
}

int vtkSchlierenFilter::GetQuality()
{
  int quality = INTERACTIVE;
  while (quality < CUSTOM &&
    !std::all_of(qualitySettings.begin(), qualitySettings.end(),
      [&](const QualitySetting& setting)
      { return setting.Get(*this) == setting.Values[static_cast<std::size_t>(quality)]; }))
  {
    ++quality;
  }
  return quality;
}

const char* vtkSchlierenFilter::GetQualitySetting(int number)
{
  const auto index = static_cast<std::size_t>(number);
  return index < qualitySettings.size() ? qualitySettings[index].Property : nullptr;
}

double vtkSchlierenFilter::GetQualityValue(int quality, int number)
{
  const auto index = static_cast<std::size_t>(number);
  return quality >= INTERACTIVE && quality < CUSTOM && index < qualitySettings.size()
    ? qualitySettings[index].Values[static_cast<std::size_t>(quality)]
    : 0;
}

double vtkSchlierenFilter::GetQualityError(int quality, int cutoff)
{
  const QualityError error = errorOf(quality);
  const schlieren::Technique technique = techniqueOf(cutoff);
  return technique.hasFringes                                 ? error.Fringes
    : technique.plane == schlieren::RecordedPlane::Background ? error.Pixels
                                                              : error.Light;
}

double vtkSchlierenFilter::GetQualityTime(int quality) { return errorOf(quality).Time; }

void vtkSchlierenFilter::SetPrecision(int precision)
{
  precision = std::clamp<int>(precision, SINGLE, DOUBLE);
  if (this->Precision != precision)
  {
    this->Precision = precision;
    this->DoublePrecision = precision == DOUBLE;
    this->Modified();
  }
}

const char* vtkSchlierenFilter::GetGrid() const
{
  const MadeRefractivity& made = *this->Inside->Refractivity;
  return made.Source ? this->Inside->Grid.c_str() : made.Grid.c_str();
}

void vtkSchlierenFilter::GetMediumBounds(double bounds[6]) const
{
  vtkMath::UninitializeBounds(bounds);
  const MadeRefractivity& made = *this->Inside->Refractivity;
  if (!made.IsThere())
  {
    return;
  }
  const schlieren::Grid grid = Internals::fieldOf(made).grid;
  vtkBoundingBox box;
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    double point[3] = { grid.origin[0], grid.origin[1], grid.origin[2] };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double length = (corner >> axis & 1) == 0
        ? 0
        : static_cast<double>(grid.dimensions[axis] - 1) * grid.spacing[axis];
      for (std::size_t row = 0; row < 3; ++row)
      {
        point[row] += grid.direction[3 * row + axis] * length;
      }
    }
    box.AddPoint(point);
  }
  box.GetBounds(bounds);
}

vtkTypeInt64 vtkSchlierenFilter::GetMediumBuilds()
{
  return this->Inside->Images.GetWork().mediumBuilds;
}

vtkTypeInt64 vtkSchlierenFilter::GetTotalRaysTraced()
{
  return this->Inside->Images.GetWork().raysTraced;
}

void vtkSchlierenFilter::SetProbedPlace(double right, double up)
{
  this->ProbedPlace[0] = right;
  this->ProbedPlace[1] = up;
}

const char* vtkSchlierenFilter::GetProbedPlace()
{
  this->Probed = pixelInWords(this->GetOutput(), this->ProbedPlace[0], this->ProbedPlace[1]);
  return this->Probed.c_str();
}

void vtkSchlierenFilter::SetLockedK(double k)
{
  if (k != this->GetLockedK())
  {
    this->Inside->SensitivityLocks[this->Cutoff].Give(k > 0 ? std::make_optional(k) : std::nullopt);
    this->Modified();
  }
}

void vtkSchlierenFilter::FitK()
{
  this->Inside->SensitivityLocks[this->Cutoff].Drop();
  this->Modified();
}

double vtkSchlierenFilter::GetLockedK() const
{
  return this->Inside->SensitivityLocks[this->Cutoff].GetKept().value_or(0);
}

void vtkSchlierenFilter::SetLockedAmbient(double ambient)
{
  if (ambient != this->GetLockedAmbient())
  {
    this->Inside->AmbientLock.Give(ambient != 0 ? std::make_optional(ambient) : std::nullopt);
    this->Modified();
  }
}

double vtkSchlierenFilter::GetLockedAmbient() const
{
  return this->Inside->AmbientLock.GetKept().value_or(0);
}

void vtkSchlierenFilter::SetLockedDepth(double depth)
{
  if (depth != this->GetLockedDepth())
  {
    this->Inside->DepthLock.Give(depth > 0 ? std::make_optional(depth) : std::nullopt);
    this->Modified();
  }
}

double vtkSchlierenFilter::GetLockedDepth() const
{
  return this->Inside->DepthLock.GetKept().value_or(0);
}
