// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What Python's ctypes calls (schlieren_core/__init__.py, whose class _Request has the same members as Request). No exception
// leaves it: a mistake is a text.
#include "Schlieren.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <string>

#define SCHLIEREN_EXPORT extern "C" __attribute__((visibility("default")))

namespace
{

/// An image that is requested. Metres, degrees, row-major arrays; what is not a number is left to the tracer.
struct Request
{
  std::int64_t points[3];  ///< along x, y, z
  double origin[3];        ///< of the first point
  double spacing[3];       ///< between points
  const double* samples;   ///< n - 1 of each point, x fastest
  double viewDirection[3]; ///< of sight
  double viewUp[3];        ///< up in the image
  double parallelScale;    ///< half the image's height; 0: all of the data
  double knifeEdgeAngle;   ///< 0 measures the deflection along the image's right
  double k;                ///< 1/rad; not a number: automatic
  double wavelength;       ///< in vacuum
  double screenDistance;   ///< of a shadowgraph; not a number: automatic
  double fringeSpacing;    ///< 0: infinite fringes
  double fringeAngle;      ///< in which the carrier's phase grows
  double ambient;         ///< n - 1 of the surroundings; not a number: found at the data's boundary
  std::int32_t technique; ///< schlieren::Cutoff
  std::int32_t size[2];   ///< pixels, width and height
  std::int32_t raysPerPixel; ///< 1 or more
  std::int32_t threads;      ///< 0: all
};

/// Where the image goes: arrays of the image's size, bottom row first, and numbers.
struct Result
{
  float* intensity;  ///< 1 for each pixel
  float* color;      ///< 3, where hasColor
  float* deflection; ///< 2: direction cosines along the image's right and up
  double* path;      ///< 1: optical path difference, metres
  double k, screenDistance, undisturbed;
  std::int32_t hasColor;
};

schlieren::Scene sceneOf(const Request& request)
{
  schlieren::Scene scene;
  std::copy_n(request.viewDirection, 3, scene.view.viewDirection.begin());
  std::copy_n(request.viewUp, 3, scene.view.viewUp.begin());
  scene.view.parallelScale = request.parallelScale;
  scene.view.width = request.size[0];
  scene.view.height = request.size[1];
  scene.cutoff = schlieren::techniques.at(static_cast<std::size_t>(request.technique)).cutoff;
  scene.knifeEdgeAngle = request.knifeEdgeAngle;
  scene.wavelength = request.wavelength;
  scene.samplesPerPixel = request.raysPerPixel;
  scene.threads = request.threads;
  scene.fringes.finite = request.fringeSpacing != 0;
  scene.fringes.spacing = request.fringeSpacing;
  scene.fringes.angle = request.fringeAngle;
  scene.choosesScreen = std::isnan(request.screenDistance);
  if (!scene.choosesScreen)
  {
    scene.screenDistance = request.screenDistance;
  }
  if (!std::isnan(request.k))
  {
    scene.kScale = request.k;
  }
  if (scene.cutoff == schlieren::Cutoff::PhaseContrast)
  {
    scene.lightModel = schlieren::LightModel::Waves;
  }
  return scene;
}

} // namespace

/// K of a gas, m^3/kg, at a wavelength in metres; not a number where the gas is not known.
SCHLIEREN_EXPORT double schlieren_constant(const char* gas, double wavelength)
{
  const schlieren::Gas* found = schlieren::findGas(gas);
  return found ? found->constantAt(wavelength) : std::numeric_limits<double>::quiet_NaN();
}

/// The names of gases (kind 0) and techniques (1) by number; null behind the last one.
SCHLIEREN_EXPORT const char* schlieren_name(int kind, int number)
{
  const auto index = static_cast<std::size_t>(number);
  if (kind == 1)
  {
    return index < schlieren::techniques.size() ? schlieren::techniques[index].name : nullptr;
  }
  static std::string name; // which a string_view does not end with a zero
  const bool exists = index < schlieren::gases().size();
  name = exists ? schlieren::gases()[index].name : std::string_view();
  return exists ? name.c_str() : nullptr;
}

SCHLIEREN_EXPORT const char* schlieren_version() { return schlieren::version(); }

/// Makes an image; null, or what is wrong, which stays until the next call.
SCHLIEREN_EXPORT const char* schlieren_render(const Request* request, Result* result)
{
  static std::string message;
  try
  {
    schlieren::Field field;
    std::copy_n(request->points, 3, field.grid.dimensions.begin());
    std::copy_n(request->origin, 3, field.grid.origin.begin());
    std::copy_n(request->spacing, 3, field.grid.spacing.begin());
    field.doubles = request->samples;
    if (!std::isnan(request->ambient))
    {
      field.ambient = request->ambient;
    }
    const schlieren::Image image = schlieren::Bench().render(field, sceneOf(*request));
    std::copy(image.intensity.begin(), image.intensity.end(), result->intensity);
    std::copy(image.color.begin(), image.color.end(), result->color);
    std::copy(image.deflection.begin(), image.deflection.end(), result->deflection);
    std::copy(image.opticalPathDifference.begin(), image.opticalPathDifference.end(), result->path);
    result->k = image.kScale;
    result->screenDistance = image.screenDistance;
    result->undisturbed = image.undisturbedLevel;
    result->hasColor = image.color.empty() ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    message = error.what();
    return message.c_str();
  }
  return nullptr;
}
