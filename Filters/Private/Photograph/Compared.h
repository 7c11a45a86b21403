// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// A photograph compared with a simulated image, from both to what the user is shown.
#pragma once

#include "Common/WorkProgress.h"
#include "Photograph/CameraFit.h"
#include "Photograph/FeatureShift.h"
#include "Photograph/Placing.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

class vtkImageData;
struct PhotographSettings;

namespace filters
{

struct Compared
{
  Plane photograph; ///< at the image's points; NaN beyond it
  Plane simulated;  ///< as the camera would have recorded it
  Plane difference; ///< photograph less simulated; NaN where they are not compared
  std::optional<FeatureShift> shift;

  double scale = 0;    ///< data units per pixel of the photograph, upward
  double rotation = 0; ///< degrees to the left
  Point2 middle{};     ///< of the photograph, data units

  SimulatedLight::Values cutoff{}; ///< NaN where the technique has none, or it was not fitted
  bool isKKnown = false;           ///< of a knife edge: whether k and offset can be separated
  double contrastUncertainty = 0;  ///< one standard deviation, relative
  double kUncertainty = 0;         ///< the same
  double angleUncertainty = std::numeric_limits<double>::quiet_NaN(); ///< the same, degrees
  bool lacksFringes = false; ///< of an interferogram: no fringes explain the photograph
  bool isTiltKnown = false;  ///< of fringes: whether the flow shows the sign of their tilt
  double black = 0;
  double fullFraction = 0; ///< of the points compared: how many have all light
  double residual = 0;     ///< root mean square of the difference
  double correlation = 0;
  double shiftMedian = 0,
         shiftLarge = 0; ///< length of the shifts, and which 95 % do not exceed; data units

  std::vector<std::string> sentences; ///< what has been found
  std::vector<std::string> notes;     ///< the same for a legend
};

/**
 * Compares them in this order: place; contrast, offset, angle and black level; feature shift; once more with the photograph
 * pulled back by that. `withoutFlow` may be null. Throws std::runtime_error with a message for the user, and
 * Stopped.
 */
Compared compare(vtkImageData* image, vtkImageData* photograph, vtkImageData* withoutFlow,
  const PhotographSettings& settings, const WorkProgress& progress);

} // namespace filters
