// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What waves make on a screen of the light that rays have brought through the flow. From the plane on which it seems to be
// bent to the screen light is a scalar wave in a homogeneous medium.
#pragma once

#include "Types.h"
#include "Waves/FourierTransform.h"
#include "Waves/LightAtExit.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// sqrt(wavelength distance): how far from a ray waves carry light over a distance. Metres.
double fresnelWidth(double wavelength, double distance);

/// A screen, and the image on it. Lengths are metres.
struct Screen
{
  double wavelength = 532e-9;         ///< in vacuum
  double distance = 0;                ///< from where light leaves the data
  std::int64_t width = 0, height = 0; ///< pixels
  int raysPerPixel = 1;               ///< along each axis
  LightSource source;                 ///< collimated
  double sourceAngle = 0;             ///< degrees: across a slit, from u to v
  double planeOtherwise = 0;          ///< see bestPlane
  double largestPlane = 0;            ///< how far before the exit the plane may be
  std::size_t memoryBudget = std::size_t{ 1 } << 30;
  int threads = 0;
};

/// What has been found on the way.
struct WaveReport
{
  double fresnelWidth = 0;            ///< metres
  double blur = 0;                    ///< metres: width of a pixel and the source's image
  std::int64_t pointsPerPixel = 0;    ///< along each axis; 0: there are none
  std::int64_t columns = 0, rows = 0; ///< of points, with what is around the image
  double plane = 0;                   ///< metres before where light leaves the data
  double leastTubeRatio = 1;          ///< there
};

/// How wide the light around an image is that may reach it over a distance, metres: eight Fresnel widths, what is deflected
/// and what comes from an extended source.
double marginOnScreen(
  const Screen& screen, double wavelengthInMedium, double distance, double largestDeflection);

/// The width of the blur by a pixel and the source's image, metres.
double blurOnScreen(const LightSource& source, double pixel, double distance);

/// The light of each pixel by undisturbed light, row by row. `light`: of the image and as many rays beside it on each
/// side. Empty if aborted. Throws Error.
std::vector<float> lightOnScreen(
  LightAtExit&& light, const Screen& screen, const Monitor& monitor, WaveReport& report);

/// The space that a field continues in.
struct FreeSpace
{
  double wavelength; ///< in the medium, as the next two in one unit of length
  double distance;
  double spacing;            ///< of points
  double carrier[2]{ 0, 0 }; ///< frequencies along u and v that have been taken off the field
};

/// Brings a field over a distance (angular spectrum), less the phase of light of the carrier. Light that would leave the
/// field is left out (Matsushima and Shimobaba 2009). False if aborted.
bool propagate(
  ComplexField& field, const FreeSpace& space, int threads, const Monitor& monitor = {});

} // namespace schlieren
