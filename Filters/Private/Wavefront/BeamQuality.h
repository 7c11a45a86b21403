// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a wavefront does to a beam: its aberrations, and the light in the far field.
#pragma once

#include "Wavefront/Aperture.h"

#include <array>
#include <vector>

namespace filters
{

/// Points along a side of the far field's image.
constexpr int farFieldPoints = 257;

struct BeamQuality
{
  std::vector<double> residual; ///< metres, row by row; NaN beyond the aperture
  std::vector<double> zernike;  ///< metres, of the whole wavefront; the first is Noll's 1
  std::array<double, 2> tilt{}; ///< that has been removed, to the right and up: radians
  double pixels = 0;            ///< of the aperture
  double rms = 0;               ///< of the residual: metres
  double peakToValley = 0;      ///< likewise
  double strehl = 0;            ///< the far field's peak over that of a plane wavefront
  double marechal = 0;          ///< exp(-(2 pi rms / wavelength)^2)
  double energyWithinAiry = 0; ///< fraction of the energy within 1.22 wavelengths over the diameter

  double angle = 0;                ///< between points of the far field: radians
  std::vector<double> pointSpread; ///< far field, row by row; 1: the peak of a plane wavefront
  std::vector<double> energy; ///< fraction within each point's angle; NaN beyond the image's sides
};

struct BeamSettings
{
  double metresPerPixel = 1;
  double wavelength = 632.8e-9; ///< metres
  int zernikeTerms = 15;
  bool removesFocus = false;
};

/**
 * Removes piston, tilt and, with removesFocus, focus by least squares and finds what is left. `path`: metres, row by row, finite in
 * the aperture. The unit circle of Zernike's polynomials is the round aperture, or the circle around the square one. Throws
 * std::runtime_error where there are too few pixels.
 */
BeamQuality qualityOf(const std::vector<double>& path, int columns, const Aperture& aperture,
  const BeamSettings& settings);

} // namespace filters
