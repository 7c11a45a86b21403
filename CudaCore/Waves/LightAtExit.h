// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// From what rays carry where they leave the data to light on one plane, at regular points. What rays carry is stored where
// they start; it belongs where they are on that plane.
#pragma once

#include "Types.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// One value for each ray of a rectangle, row by row.
using RayValues = std::vector<double>;

/// What the rays of a rectangle carry, which start `spacing` apart along u and v. Lengths are metres, paths vacuum's.
struct LightAtExit
{
  std::int64_t columns = 0, rows = 0;
  double spacing = 1;
  double refractiveIndex = 1;           ///< of what light leaves the data into
  RayValues path;                       ///< less that of undisturbed light
  RayValues deflection[2];              ///< direction cosines along u and v
  RayValues displacement[2];            ///< along u and v
  std::vector<float> passing;           ///< the fraction of a ray's light that no body stops
  std::vector<unsigned char> isBlocked; ///< 1: what the ray itself carries means nothing

  std::size_t size() const { return path.size(); }
  void resize(std::int64_t ofColumns, std::int64_t ofRows);
};

/// Gives blocked rays what the nearest one carries that is not.
void continueBehindBodies(LightAtExit& light);

/// How far before the exit plane rays seem to be bent: where, traced back straight, they are displaced least (least squares).
/// `otherwise`: where they are hardly bent.
double bestPlane(const LightAtExit& light, double otherwise);

/// Light on a plane, at points `spacing` apart.
struct LightOnPlane
{
  std::int64_t columns, rows;
  double spacing;
  RayValues path;
  RayValues amplitude; ///< by undisturbed light, without bodies
  std::vector<float> passing;
  double leastTubeRatio; ///< of the areas between rays on the plane and where they start
};

/// Values between the points of a rectangle, linearly; beyond it, those of its border.
double linearAt(const std::vector<float>& values, std::int64_t columns, std::int64_t rows,
  double column, double row);

/// Ratios of areas that are no larger: rays cross, or nearly do, and light has no one path any more.
constexpr double leastTubeRatioAllowed = 0.05;

/// Traces light back straight by `back` metres from where it leaves the data. Throws Error where rays cross before.
LightOnPlane bringToPlane(const LightAtExit& light, double back, int threads);

} // namespace schlieren
