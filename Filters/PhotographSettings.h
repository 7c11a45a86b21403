// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PhotographSettings_h
#define PhotographSettings_h

/// Values of the properties of vtkCompareWithPhotograph under their names, as in SchlierenSettings.h. Plugin/Photograph.xml
/// describes them.
struct PhotographSettings
{
  // values: Placement, FitPlace
  /// Values of Placement.
  enum Placements
  {
    PLACE_FILL_IMAGE = 0,
    PLACE_BY_HAND = 1,
    PLACE_ONE_POINT = 2,
    PLACE_TWO_POINTS = 3
  };

  /// Values of FitPlace.
  enum FitPlaces
  {
    FIT_OFF = 0,
    FIT_BODY = 1,
    FIT_FLOW = 2
  };

  // end

  // members: rest
  int Comparison = 3;
  double SwipePosition = 0.5;
  int Placement = 0;
  double PhotographPosition[2] = { 0, 0 };
  double PhotographRotation = 0;
  double PhotographScale = 0;
  double PhotographPoint1[2] = { 0, 0 };
  double FlowPoint1[2] = { 0, 0 };
  double PhotographPoint2[2] = { 1, 0 };
  double FlowPoint2[2] = { 1, 0 };
  double PixelAspect = 1;
  int FitPlace = 0;
  double MirrorCenter[2] = { 0, 0 };
  double MirrorRadius = 0;
  double Gamma = 1;
  double BlackLevel = -1;
  bool FitCutoff = true;
  bool FindFeatureShift = true;
  // end

  template <class Use>
  static void visit(const Use& use)
  {
    using S = PhotographSettings;
    // visits: rest
    use("Comparison", &S::Comparison);
    use("SwipePosition", &S::SwipePosition);
    use("Placement", &S::Placement);
    use("PhotographPosition", &S::PhotographPosition);
    use("PhotographRotation", &S::PhotographRotation);
    use("PhotographScale", &S::PhotographScale);
    use("PhotographPoint1", &S::PhotographPoint1);
    use("FlowPoint1", &S::FlowPoint1);
    use("PhotographPoint2", &S::PhotographPoint2);
    use("FlowPoint2", &S::FlowPoint2);
    use("PixelAspect", &S::PixelAspect);
    use("FitPlace", &S::FitPlace);
    use("MirrorCenter", &S::MirrorCenter);
    use("MirrorRadius", &S::MirrorRadius);
    use("Gamma", &S::Gamma);
    use("BlackLevel", &S::BlackLevel);
    use("FitCutoff", &S::FitCutoff);
    use("FindFeatureShift", &S::FindFeatureShift);
    // end
  }
};

#endif
