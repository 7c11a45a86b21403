// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How a camera records the simulated light, and the fit of that to a photograph.
#pragma once

#include "Photograph/Plane.h"
#include "Photograph/SimulatedLight.h"

#include <array>
#include <cstddef>
#include <functional>

namespace filters
{

/// A camera: the light is blurred, and value = black + (undisturbed - black) r^exponent of the light r relative to undisturbed light. What undisturbed light is
/// recorded as is known from a photograph without flow, or a quadratic surface over the image.
struct Camera
{
  double exponent = 1;
  double black = 0;
  double blur = 0.7; ///< standard deviation, points of the image
  std::array<double, 6>
    surface{}; ///< ln of (undisturbed - black): 1, x, y, x^2, y^2, x y; x, y from -1 to 1

  /// `column` and `row` of so many; ln (undisturbed - black).
  double surfaceAt(double x, double y) const;
};

/// What is compared, at the points of the image.
struct Exposure
{
  Plane photograph;  ///< 0 to 1; NaN beyond it
  Plane withoutFlow; ///< of the same size, or empty
  Plane known;       ///< 1 where both are known and may be compared, else 0
};

struct CameraFit
{
  SimulatedLight::Parameters light;
  Camera camera;
  double cost = 0; ///< the sum of the robust loss, per block that was compared
};

/// What a fit may change.
enum class Fitted
{
  Brightness,         ///< the surface where there is no photograph without flow
  BrightnessAndBlack, ///< and the black level
  Light,              ///< and the parameters of the light, but not the black level
  All
};

/// Whether the blur is fitted, too. A fit that starts with another contrast can end in the widest blur instead of the right contrast.
enum class Blur
{
  Kept,
  Fitted
};

/**
 * Fits a camera and the light's free parameters by Levenberg's and Marquardt's method with the robust loss
 * 2 s^2 (sqrt(1 + (difference / s)^2) - 1), s = 0.02, to the means of both over blocks of the image (about 200 blocks to a row). `uses`: of a
 * block's column and row, each 0 to 1, whether it is compared; null: all. Returns `start` unchanged where nothing is to
 * be fitted, or there are fewer blocks than unknowns.
 */
CameraFit fitCamera(const SimulatedLight& light, const Exposure& exposure, const CameraFit& start,
  Fitted what, Blur blur = Blur::Fitted, const std::function<bool(double, double)>& uses = nullptr);

/// Returns the image as the camera records it. Beyond the photograph, undisturbed light is as bright as in its median.
Plane recorded(const SimulatedLight& light, const Exposure& exposure, const CameraFit& fit);

} // namespace filters
