// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SchlierenFilterInternals.h"

#include "QualityPresets.h"
#include "RealOptics.h"

#include "vtkPiecewiseFunction.h"

#include <algorithm>
#include <limits>

//------------------------------------------------------------------------------
void vtkSchlierenFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Medium:\n";
  this->Medium->PrintSelf(os, indent.GetNextIndent());
  os << indent << "LengthScale: " << this->LengthScale << "\n";
  os << indent << "AutoAmbientRefractivity: " << this->AutoAmbientRefractivity << "\n";
  os << indent << "AmbientRefractivity: " << this->AmbientRefractivity << "\n";
  os << indent << "LockAmbient: " << this->LockAmbient << "\n";
  os << indent << "LockedAmbient: " << this->GetLockedAmbient() << "\n";
  os << indent << "Wavelength: " << this->Wavelength << "\n";
  os << indent << "ViewDirection: " << this->ViewDirection[0] << " " << this->ViewDirection[1]
     << " " << this->ViewDirection[2] << "\n";
  os << indent << "ViewUp: " << this->ViewUp[0] << " " << this->ViewUp[1] << " " << this->ViewUp[2]
     << "\n";
  os << indent << "HasFocalPoint: " << this->HasFocalPoint << "\n";
  os << indent << "FocalPoint: " << this->FocalPoint[0] << " " << this->FocalPoint[1] << " "
     << this->FocalPoint[2] << "\n";
  os << indent << "ParallelScale: " << this->ParallelScale << "\n";
  os << indent << "ImageSize: " << this->ImageSize[0] << " " << this->ImageSize[1] << "\n";
  os << indent << "Cutoff: " << this->Cutoff << "\n";
  os << indent << "KnifeEdgeAngle: " << this->KnifeEdgeAngle << "\n";
  os << indent << "CutoffOffset: " << this->CutoffOffset << "\n";
  os << indent << "InvertCutoff: " << this->InvertCutoff << "\n";
  os << indent << "AutoKScale: " << this->AutoKScale << "\n";
  os << indent << "LockK: " << this->LockK << "\n";
  os << indent << "LockedK: " << this->GetLockedK() << "\n";
  os << indent << "KScale: " << this->KScale << "\n";
  os << indent << "KFromOptics: " << this->KFromOptics << "\n";
  os << indent << "FocalLength: " << this->FocalLength << "\n";
  os << indent << "SourceWidth: " << this->SourceWidth << "\n";
  os << indent << "SourceLength: " << this->SourceLength << "\n";
  os << indent << "CutoffPosition: " << this->CutoffPosition << "\n";
  os << indent << "KScaleUsed: " << this->KScaleUsed << "\n";
  os << indent << "Sensitivity: " << this->Sensitivity << "\n";
  os << indent << "GradedFilter: " << this->GradedFilter << "\n";
  os << indent << "ColorFilterImage: " << this->ColorFilterImage << "\n";
  os << indent << "FringeMode: " << this->FringeMode << "\n";
  os << indent << "FringeSpacing: " << this->FringeSpacing << "\n";
  os << indent << "FringeAngle: " << this->FringeAngle << "\n";
  os << indent << "BeamAngle: " << this->BeamAngle << "\n";
  os << indent << "WhiteLight: " << this->WhiteLight << "\n";
  os << indent << "ScreenDistance: " << this->ScreenDistance << "\n";
  os << indent << "FocusOffset: " << this->FocusOffset << "\n";
  os << indent << "LightSource: " << this->LightSource << "\n";
  os << indent << "SourceDistance: " << this->SourceDistance << "\n";
  os << indent << "SourceShape: " << this->SourceShape << "\n";
  os << indent << "BackgroundPattern: " << this->BackgroundPattern << "\n";
  os << indent << "BackgroundDistance: " << this->BackgroundDistance << "\n";
  os << indent << "BackgroundPeriod: " << this->BackgroundPeriod << "\n";
  os << indent << "BackgroundAngle: " << this->BackgroundAngle << "\n";
  os << indent << "BackgroundImage: " << this->BackgroundImage << "\n";
  os << indent << "ColorByField: " << this->ColorByField << "\n";
  os << indent << "FieldColors:";
  for (const double value : this->FieldColors)
  {
    os << " " << value;
  }
  os << "\n";
  os << indent << "Quality: " << this->GetQuality() << "\n";
  for (const QualitySetting& setting : qualitySettings)
  {
    os << indent << setting.Property << ": " << setting.Get(this) << "\n";
  }
  os << indent << "ExposureTime: " << this->ExposureTime << "\n";
  os << indent << "ExposureSamples: " << this->ExposureSamples << "\n";
  os << indent << "NoiseFilter: " << this->NoiseFilter << "\n";
  os << indent << "NoiseFilterRadius: " << this->NoiseFilterRadius << "\n";
  os << indent << "HistogramSize: " << this->HistogramSize << "\n";
  os << indent << "MemoryBudget: " << this->MemoryBudget << "\n";
  os << indent << "MediumMemory: " << this->MediumMemory << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Device: " << this->Device << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "GatherLimit: " << this->GatherLimit << "\n";
  os << indent << "PreviewReduction: " << this->PreviewReduction << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "Finished: " << this->GetFinished() << "\n";
  os << indent << "PictureCount: " << this->PictureCount << "\n";
  os << indent << "Status: " << this->Status << "\n";
  os << indent << "FollowedView: " << this->FollowedView << "\n";
  os << indent << "Grid: " << this->GetGrid() << "\n";
  os << indent << "MediumBuilds: " << this->GetMediumBuilds() << "\n";
  os << indent << "TotalRaysTraced: " << this->GetTotalRaysTraced() << "\n";
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
void vtkSchlierenFilter::ClearFocalPoint()
{
  if (this->HasFocalPoint)
  {
    std::fill_n(this->FocalPoint, 3, 0.);
    this->HasFocalPoint = false;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::AddFieldColor(double value)
{
  this->FieldColors.push_back(value);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::ClearFieldColors()
{
  this->FieldColors.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::SetGradedFilter(vtkPiecewiseFunction* function)
{
  if (this->GradedFilter != function)
  {
    this->GradedFilter = function;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkPiecewiseFunction* vtkSchlierenFilter::GetGradedFilter() const { return this->GradedFilter; }

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetKScaleOfOptics()
{
  return this->FocalLength > 0 && this->SourceWidth > 0
    ? this->FocalLength / (metresPerMillimetre * this->SourceWidth)
    : std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetCutoffOffsetOfOptics()
{
  return this->SourceWidth > 0 ? this->CutoffPosition / this->SourceWidth
                               : std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetGladstoneDaleConstantUsed()
{
  this->PassToMedium();
  return this->Medium->GetGladstoneDaleConstantUsed();
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::SetQuality(int quality)
{
  if (quality < INTERACTIVE || quality >= CUSTOM)
  {
    return;
  }
  for (const QualitySetting& setting : qualitySettings)
  {
    setting.Set(this, setting.Values[static_cast<std::size_t>(quality)]);
  }
}

//------------------------------------------------------------------------------
int vtkSchlierenFilter::GetQuality()
{
  int quality = INTERACTIVE;
  while (quality < CUSTOM &&
    !std::all_of(qualitySettings.begin(), qualitySettings.end(),
      [&](const QualitySetting& setting)
      { return setting.Get(this) == setting.Values[static_cast<std::size_t>(quality)]; }))
  {
    ++quality;
  }
  return quality;
}

//------------------------------------------------------------------------------
const char* vtkSchlierenFilter::GetQualitySetting(int number)
{
  const auto index = static_cast<std::size_t>(number);
  return index < qualitySettings.size() ? qualitySettings[index].Property : nullptr;
}

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetQualityValue(int quality, int number)
{
  const auto index = static_cast<std::size_t>(number);
  return quality >= INTERACTIVE && quality < CUSTOM && index < qualitySettings.size()
    ? qualitySettings[index].Values[static_cast<std::size_t>(quality)]
    : 0;
}

//------------------------------------------------------------------------------
void vtkSchlierenFilter::SetPrecision(int precision)
{
  precision = std::clamp<int>(precision, SINGLE, DOUBLE);
  if (this->Precision != precision)
  {
    this->Precision = precision;
    this->Inside->TimeBeforePrecision = this->Inside->settingsTimeOf(this->Medium);
    this->Medium->SetDoublePrecision(precision == DOUBLE);
    this->Inside->PrecisionTime = this->Medium->GetMTime();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkSchlierenFilter::GetGrid() const
{
  return this->Inside->Source ? this->Inside->Grid.c_str() : this->Medium->GetGrid();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkSchlierenFilter::GetMediumBuilds()
{
  return this->Inside->Pictures.GetBench().work().mediumBuilds;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkSchlierenFilter::GetTotalRaysTraced()
{
  return this->Inside->Pictures.GetBench().work().raysTraced;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkSchlierenFilter::GetMeshSearches() { return this->Medium->GetMeshSearches(); }

//------------------------------------------------------------------------------
vtkTypeInt64 vtkSchlierenFilter::GetMeshBuilds() { return this->Medium->GetMeshBuilds(); }

//------------------------------------------------------------------------------
vtkTypeInt64 vtkSchlierenFilter::GetGridPlans() { return this->Medium->GetGridPlans(); }

//------------------------------------------------------------------------------
void vtkSchlierenFilter::SetLockedK(double k)
{
  if (k != this->GetLockedK())
  {
    this->Inside->KLock.Give(k > 0 ? std::make_optional(k) : std::nullopt);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetLockedK() const { return this->Inside->KLock.GetKept().value_or(0); }

//------------------------------------------------------------------------------
void vtkSchlierenFilter::SetLockedAmbient(double ambient)
{
  if (ambient != this->GetLockedAmbient())
  {
    this->Inside->AmbientLock.Give(ambient != 0 ? std::make_optional(ambient) : std::nullopt);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkSchlierenFilter::GetLockedAmbient() const
{
  return this->Inside->AmbientLock.GetKept().value_or(0);
}
