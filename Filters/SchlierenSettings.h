// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef SchlierenSettings_h
#define SchlierenSettings_h

#include <string>
#include <vector>

/// Values of the properties of vtkSchlierenFilter under their names: numbers and texts, without
/// VTK. See the filter for their meaning; its setters check ranges. visit() calls a function with
/// the name and the value of each.

/// The surroundings of the data. MediumSettings are the medium's own.
struct SurroundingsSettings
{
  double LengthScale = 1;
  double AmbientRefractivity = -1; ///< up to -1: found
  int ExitInto = 0;
  double ExitRefractivity = 2.7e-4;
  double Wavelength = 632.8;

  template <class Visit>
  void visit(const Visit& use) const
  {
    use("LengthScale", this->LengthScale);
    use("AmbientRefractivity", this->AmbientRefractivity);
    use("ExitInto", this->ExitInto);
    use("ExitRefractivity", this->ExitRefractivity);
    use("Wavelength", this->Wavelength);
  }
};

struct ViewSettings
{
  double ViewDirection[3] = { 0, 0, -1 };
  double ViewUp[3] = { 0, 1, 0 };
  bool FaceFlatData = true;
  bool HasFocalPoint = false;
  double FocalPoint[3] = { 0, 0, 0 };
  double ParallelScale = 0;
  double ViewAngle = 0;
  int ImageSize[2] = { 512, 512 };

  template <class Visit>
  void visit(const Visit& use) const
  {
    use("ViewDirection", this->ViewDirection);
    use("ViewUp", this->ViewUp);
    use("FaceFlatData", this->FaceFlatData);
    use("HasFocalPoint", this->HasFocalPoint);
    use("FocalPoint", this->FocalPoint);
    use("ParallelScale", this->ParallelScale);
    use("ViewAngle", this->ViewAngle);
    use("ImageSize", this->ImageSize);
  }
};

/// All but the graded filter, which is an object.
struct OpticsSettings
{
  // Values without an enumeration in the tracer.
  static constexpr int lockOff = 0, lockAlways = 2; // LockK
  static constexpr int scenePattern = 3;            // BackgroundPattern
  static constexpr int lightOfRays = 0;             // LightModel

  int Cutoff = 0;
  double KnifeEdgeAngle = 0;
  double CutoffOffset = 0;
  bool InvertCutoff = false;
  bool AutoKScale = true;
  int LockK = 1; // over time
  double KScale = 1000;
  bool KFromOptics = false;
  double FocalLength = 1;
  double SourceWidth = 1;
  double SourceLength = 10;
  double CutoffPosition = 0;
  std::string ColorFilterImage;
  double FringeSpacing = 0;
  double FringeAngle = 0;
  bool WhiteLight = false;
  double ScreenDistance = -1;
  double FocusOffset = 0;
  double SourceDistance = 0;
  int SourceShape = 0;
  int LightModel = lightOfRays;
  double Bandwidth = 0;
  double PhasePlateDiameter = 0;
  double PhasePlateDelay = 0.25;
  double PhasePlateTransmission = 1;
  int BackgroundPattern = 0;
  double BackgroundDistance = -1;
  double BackgroundPeriod = 0;
  std::string BackgroundImage;
  double FNumber = 0;
  double LensFocalLength = 50;
  double FocusDistance = 0;
  double SensorWidth = 0;
  bool ColorByField = false;
  std::vector<double> FieldColors;

  template <class Visit>
  void visit(const Visit& use) const
  {
    use("Cutoff", this->Cutoff);
    use("KnifeEdgeAngle", this->KnifeEdgeAngle);
    use("CutoffOffset", this->CutoffOffset);
    use("InvertCutoff", this->InvertCutoff);
    use("AutoKScale", this->AutoKScale);
    use("LockK", this->LockK);
    use("KScale", this->KScale);
    use("KFromOptics", this->KFromOptics);
    use("FocalLength", this->FocalLength);
    use("SourceWidth", this->SourceWidth);
    use("SourceLength", this->SourceLength);
    use("CutoffPosition", this->CutoffPosition);
    use("ColorFilterImage", this->ColorFilterImage);
    use("FringeSpacing", this->FringeSpacing);
    use("FringeAngle", this->FringeAngle);
    use("WhiteLight", this->WhiteLight);
    use("ScreenDistance", this->ScreenDistance);
    use("FocusOffset", this->FocusOffset);
    use("SourceDistance", this->SourceDistance);
    use("SourceShape", this->SourceShape);
    use("LightModel", this->LightModel);
    use("Bandwidth", this->Bandwidth);
    use("PhasePlateDiameter", this->PhasePlateDiameter);
    use("PhasePlateDelay", this->PhasePlateDelay);
    use("PhasePlateTransmission", this->PhasePlateTransmission);
    use("BackgroundPattern", this->BackgroundPattern);
    use("BackgroundDistance", this->BackgroundDistance);
    use("BackgroundPeriod", this->BackgroundPeriod);
    use("BackgroundImage", this->BackgroundImage);
    use("FNumber", this->FNumber);
    use("LensFocalLength", this->LensFocalLength);
    use("FocusDistance", this->FocusDistance);
    use("SensorWidth", this->SensorWidth);
    use("ColorByField", this->ColorByField);
    use("FieldColors", this->FieldColors);
  }
};

/// The properties that presets of Quality set (see QualityPresets.h, which has their values), and the target that chooses
/// some of them instead.
struct AccuracySettings
{
  int PathModel = 0;
  double StepSize = 0;
  double HomogeneityTolerance = 0;
  int SamplesPerPixel = 0;
  int Precision = 0;
  double MediumTolerance = 0;
  double TargetError = 0;

  template <class Visit>
  void visit(const Visit& use) const
  {
    use("PathModel", this->PathModel);
    use("StepSize", this->StepSize);
    use("HomogeneityTolerance", this->HomogeneityTolerance);
    use("SamplesPerPixel", this->SamplesPerPixel);
    use("Precision", this->Precision);
    use("MediumTolerance", this->MediumTolerance);
    use("TargetError", this->TargetError);
  }
};

struct FilmSettings
{
  double SmoothingRadius = 0;
  int PreviewReduction = 1;
  bool ErrorEstimate = false;
  double FullWell = 0;
  double Exposure = 0.8;
  double ReadNoise = 10;
  double Gamma = 1;
  int BitDepth = 8;

  template <class Visit>
  void visit(const Visit& use) const
  {
    use("SmoothingRadius", this->SmoothingRadius);
    use("PreviewReduction", this->PreviewReduction);
    use("ErrorEstimate", this->ErrorEstimate);
    use("FullWell", this->FullWell);
    use("Exposure", this->Exposure);
    use("ReadNoise", this->ReadNoise);
    use("Gamma", this->Gamma);
    use("BitDepth", this->BitDepth);
  }
};

/// Resources for computing, which images do not depend on.
struct ResourceSettings
{
  int MediumMemory = 1024;
  int Device = 0;
  int NumberOfThreads = 0;
  int GatherLimit = 1000000;
  double TimeLimit = 0;

  template <class Visit>
  void visit(const Visit& use) const
  {
    use("MediumMemory", this->MediumMemory);
    use("Device", this->Device);
    use("NumberOfThreads", this->NumberOfThreads);
    use("GatherLimit", this->GatherLimit);
    use("TimeLimit", this->TimeLimit);
  }
};

struct SchlierenSettings : SurroundingsSettings,
                           ViewSettings,
                           OpticsSettings,
                           AccuracySettings,
                           FilmSettings,
                           ResourceSettings
{
  template <class Visit>
  void visit(const Visit& use) const
  {
    this->SurroundingsSettings::visit(use);
    this->ViewSettings::visit(use);
    this->OpticsSettings::visit(use);
    this->AccuracySettings::visit(use);
    this->FilmSettings::visit(use);
    this->ResourceSettings::visit(use);
  }
};

#endif
