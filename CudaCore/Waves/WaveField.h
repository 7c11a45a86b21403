// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Types.h"
#include "Waves/FourierTransform.h"
#include "Waves/LightAtExit.h"

#include <cstddef>
#include <cstdint>

namespace schlieren
{

/// The points of a field, of which there are some for each ray, and others around the rays.
struct WaveGrid
{
  std::int64_t pointsPerRay = 1;      ///< along each axis
  std::int64_t columns = 0, rows = 0; ///< of points
  std::int64_t left = 0, below = 0;   ///< columns and rows before those of the rays
  double spacing = 0;                 ///< metres
  double carrier[2]{ 0,
    0 }; ///< frequencies along u and v that are taken off the field, cycles per metre
  double largestDeflection = 0; ///< radians, without the carrier
};

/// What the points of a field have to satisfy. Lengths are metres.
struct GridRequest
{
  double wavelength;         ///< in vacuum
  double margin;             ///< that the field needs around the image
  std::int64_t border;       ///< rays beside the image, on each side
  std::int64_t raysPerPixel; ///< along each axis
  int fields;                ///< that are there at once
  std::size_t memoryBudget;  ///< bytes
};

/// The least number of points for a length along which neighbours differ by a quarter of a wave at the most.
double pointsFor(double length, double largestDeflection, double wavelengthInMedium);

/// Finds the points that light on its plane needs. Throws Error where they need more memory than there may be.
WaveGrid gridFor(const LightAtExit& light, const GridRequest& request);

/// Takes the carrier's paths off those of light, which begin at the first ray, and then their median along the border, which is
/// returned: light there is about 1, as undisturbed light around it.
double takeOffCommonPath(LightOnPlane& plane, const WaveGrid& grid, double wavelength);

/// The light of a plane, without its common path, as a wave by undisturbed light, which is 1, less undisturbed light. It falls to
/// that within `taper` rays from the ends.
ComplexField fieldOf(
  const LightOnPlane& plane, const WaveGrid& grid, double wavelength, double taper, int threads);

} // namespace schlieren
