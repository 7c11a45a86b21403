// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef SchlierenSettings_h
#define SchlierenSettings_h

#include <string>
#include <vector>

/// Values of the properties of vtkSchlierenFilter under their names: numbers and texts, without
/// VTK. Plugin/Schlieren.xml describes them; Utilities/property_tables.py makes what stands between
/// "members" or "visits" and "end". visit() calls a function with the name of each and a pointer to
/// its member. MediumSettings are the medium's own.

struct ViewSettings
{
  bool FaceFlatData = true;
  bool HasFocalPoint = false;
  double FocalPoint[3] = { 0, 0, 0 };
  // members: View
  double ViewDirection[3] = { 0, 0, -1 };
  double ViewUp[3] = { 0, 1, 0 };
  double ParallelScale = 0;
  double ViewAngle = 0;
  int ImageSize[2] = { 0, 0 };
  // end

  template <class Use>
  static void visit(const Use& use)
  {
    using S = ViewSettings;
    use("FaceFlatData", &S::FaceFlatData);
    use("HasFocalPoint", &S::HasFocalPoint);
    use("FocalPoint", &S::FocalPoint);
    // visits: View
    use("ViewDirection", &S::ViewDirection);
    use("ViewUp", &S::ViewUp);
    use("ParallelScale", &S::ParallelScale);
    use("ViewAngle", &S::ViewAngle);
    use("ImageSize", &S::ImageSize);
    // end
  }
};

/// The properties that presets of Quality set (see QualityPresets.h, which has their values), and the target that chooses
/// some of them instead.
struct AccuracySettings
{
  double TargetError = 0; // of ParaView's filter -1
  // members: PathModel, StepSize, SamplesPerPixel, Precision, MediumTolerance, TargetError
  int PathModel = 1;
  double StepSize = 2;
  int SamplesPerPixel = 1;
  int Precision = 0;
  double MediumTolerance = 0.003;
  // end

  template <class Use>
  static void visit(const Use& use)
  {
    using S = AccuracySettings;
    // visits: PathModel, StepSize, SamplesPerPixel, Precision, MediumTolerance, TargetError
    use("PathModel", &S::PathModel);
    use("StepSize", &S::StepSize);
    use("SamplesPerPixel", &S::SamplesPerPixel);
    use("Precision", &S::Precision);
    use("MediumTolerance", &S::MediumTolerance);
    use("TargetError", &S::TargetError);
    // end
  }
};

/// All but the graded filter, which is an object.
struct SchlierenSettings : ViewSettings, AccuracySettings
{
  // values: KMode, BackgroundPattern, LightModel
  /// Values of KMode.
  enum KModes
  {
    K_AUTOMATIC = 0,
    K_AUTOMATIC_KEPT = 1,
    K_VALUE = 2,
    K_BENCH = 3
  };

  /// Values of BackgroundPattern.
  enum BackgroundPatterns
  {
    DOTS = 0,
    STRIPES = 1,
    PICTURE = 2
  };

  /// Values of LightModel.
  enum LightModels
  {
    LIGHT_RAYS = 0,
    LIGHT_WAVES = 1,
    LIGHT_AUTO = 2
  };

  // end

  double Wavelength = 632.8;
  int PreviewReduction = 1;
  // members: rest
  double LengthScale = 1;
  double AmbientRefractivity = -1;
  int ExitInto = 0;
  double ExitRefractivity = 2.7e-4;
  int Cutoff = 0;
  double KnifeEdgeAngle = 0;
  double CutoffOffset = 0;
  int KMode = 1;
  double KScale = 1000;
  double MirrorFocalLength = 1;
  double SourceWidth = 1;
  std::string ColorFilterImage;
  double FringeSpacing = 0;
  double FringeAngle = 0;
  int BackgroundPattern = 0;
  double BackgroundDistance = -1;
  double BackgroundPeriod = 0;
  std::string BackgroundImage;
  double ScreenDistance = -1;
  double FocusOffset = 0;
  double FNumber = 0;
  double LensFocalLength = 50;
  double FocusDistance = 0;
  double SensorWidth = 0;
  double SourceDistance = 0;
  int SourceShape = 0;
  double SourceLength = 10;
  int LightModel = 0;
  double PhasePlateDiameter = 0;
  double PhasePlateDelay = 0.25;
  double PhasePlateTransmission = 1;
  double SmoothingRadius = 0;
  bool ErrorEstimate = false;
  int MediumMemory = 1024;
  int Device = 0;
  int NumberOfThreads = 0;
  int GatherLimit = 1000000;
  double TimeLimit = 0;
  // end

  template <class Use>
  static void visit(const Use& use)
  {
    using S = SchlierenSettings;
    ViewSettings::visit(use);
    AccuracySettings::visit(use);
    use("Wavelength", &S::Wavelength);
    use("PreviewReduction", &S::PreviewReduction);
    // visits: rest
    use("LengthScale", &S::LengthScale);
    use("AmbientRefractivity", &S::AmbientRefractivity);
    use("ExitInto", &S::ExitInto);
    use("ExitRefractivity", &S::ExitRefractivity);
    use("Cutoff", &S::Cutoff);
    use("KnifeEdgeAngle", &S::KnifeEdgeAngle);
    use("CutoffOffset", &S::CutoffOffset);
    use("KMode", &S::KMode);
    use("KScale", &S::KScale);
    use("MirrorFocalLength", &S::MirrorFocalLength);
    use("SourceWidth", &S::SourceWidth);
    use("ColorFilterImage", &S::ColorFilterImage);
    use("FringeSpacing", &S::FringeSpacing);
    use("FringeAngle", &S::FringeAngle);
    use("BackgroundPattern", &S::BackgroundPattern);
    use("BackgroundDistance", &S::BackgroundDistance);
    use("BackgroundPeriod", &S::BackgroundPeriod);
    use("BackgroundImage", &S::BackgroundImage);
    use("ScreenDistance", &S::ScreenDistance);
    use("FocusOffset", &S::FocusOffset);
    use("FNumber", &S::FNumber);
    use("LensFocalLength", &S::LensFocalLength);
    use("FocusDistance", &S::FocusDistance);
    use("SensorWidth", &S::SensorWidth);
    use("SourceDistance", &S::SourceDistance);
    use("SourceShape", &S::SourceShape);
    use("SourceLength", &S::SourceLength);
    use("LightModel", &S::LightModel);
    use("PhasePlateDiameter", &S::PhasePlateDiameter);
    use("PhasePlateDelay", &S::PhasePlateDelay);
    use("PhasePlateTransmission", &S::PhasePlateTransmission);
    use("SmoothingRadius", &S::SmoothingRadius);
    use("ErrorEstimate", &S::ErrorEstimate);
    use("MediumMemory", &S::MediumMemory);
    use("Device", &S::Device);
    use("NumberOfThreads", &S::NumberOfThreads);
    use("GatherLimit", &S::GatherLimit);
    use("TimeLimit", &S::TimeLimit);
    // end
  }
};

#endif
