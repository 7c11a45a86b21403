// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What waves make on a screen of the light that rays have brought through the flow. From the plane on which it seems to be
// bent to the screen light is a scalar wave in a homogeneous medium.
#pragma once

#include "Types.h"
#include "Waves/FourierTransform.h"
#include "Waves/LightAtExit.h"
#include "Waves/WaveField.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace schlieren
{

/// sqrt(wavelength distance): how far from a ray waves carry light over a distance. Metres.
double fresnelWidth(double wavelength, double distance);

/// A screen, or a plane that is imaged, and the image on it. Lengths are metres.
struct Screen
{
  double wavelength = 532e-9;         ///< in vacuum
  double distance = 0;                ///< from where light leaves the data; less than 0: before
  std::int64_t width = 0, height = 0; ///< pixels
  int raysPerPixel = 1;               ///< along each axis
  LightSource source;                 ///< collimated
  double sourceAngle = 0;             ///< degrees: across a slit, from u to v
  double planeOtherwise = 0;          ///< see bestPlane
  double largestPlane = 0;            ///< how far before the exit the plane may be
  std::optional<PointSource>
    pointSource{}; ///< of light that diverges; lengths on the screen are then those of the image
  std::size_t memoryBudget = std::size_t{ 1 } << 30;
  int threads = 0;
};

/// The pixels that rays have been traced for beside an image, on each side.
std::int64_t pixelsAround(const LightAtExit& light, const Screen& screen);

/// How wide the light around an image is that may reach it over a distance, metres: eight Fresnel widths, what is deflected
/// and what comes from an extended source.
double marginOnScreen(
  const Screen& screen, double wavelengthInMedium, double distance, double largestDeflection);

/// The width of the blur by a pixel and the source's image, metres.
double blurOnScreen(const LightSource& source, double pixel, double distance);

/// The space that a field crosses.
struct FreeSpace
{
  double wavelength; ///< in the medium, as the next two in one unit of length
  double distance;
  double spacing;            ///< of points
  double carrier[2]{ 0, 0 }; ///< frequencies along u and v that have been taken off the field
};

/// The factors by which space multiplies a spectrum (angular spectrum), less the phase of light of the carrier. Light that would
/// leave the field is left out (Matsushima and Shimobaba 2009).
class SpaceFilter
{
public:
  SpaceFilter(const FreeSpace& space, const ComplexField& field);

  /// Of the frequencies of a field, without the carrier.
  std::complex<double> at(double fx, double fy) const;
  /// The phase, in turns, by which the carrier's light is ahead of light along the normal: 0 or less.
  double turnsOfCarrier() const { return turns(space_.carrier[0], space_.carrier[1]); }

private:
  double turns(double fx, double fy) const;

  FreeSpace space_;
  double limits_[2];
};

/// Multiplies the spectrum of a field by what space does to it.
SpectrumFilter filterOf(const FreeSpace& space, const ComplexField& field);

/// Brings a field over a distance. False if aborted.
bool propagate(
  ComplexField& field, const FreeSpace& space, int threads, const Monitor& monitor = {});

/// A field less undisturbed light, on the plane where light seems to be bent, and what is before it.
struct FieldBeforeScreen
{
  WaveGrid grid;
  ComplexField field;
  FreeSpace space;
  double
    path; ///< less that of undisturbed light, of light that is 1 in the field where its rays begin; metres of vacuum
};

/// The distance over which parallel light makes the same image, up to its size: see parallelOf. `plane`: before where light
/// leaves the data.
double parallelDistance(const Screen& screen, double plane);

/// Makes the field of light. `light`: of the image and as many rays beside it on each side. `leastMargin`: around the image,
/// metres; `fields`: that will be there at once. Throws Error.
FieldBeforeScreen fieldBefore(const LightAtExit& light, const Screen& screen, double leastMargin,
  int fields, WaveReport& report);

/// The light of each pixel by undisturbed light, row by row: see fieldBefore. Empty if aborted.
std::vector<float> lightOnScreen(
  const LightAtExit& light, const Screen& screen, const Monitor& monitor, WaveReport& report);

} // namespace schlieren
