// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/WhiteLight.h"

#include "Types.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace schlieren
{

namespace
{

using Triple = std::array<double, 3>;

/// Colour matching functions of the CIE's 2-degree standard observer of 1931: the multi-lobe fit of C. Wyman,
/// P.-P. Sloan and P. Shirley, Simple analytic approximations to the CIE XYZ color matching functions, J.
/// Computer Graphics Techniques 2(2), 2013.
Triple colorMatching(double wavelength)
{
  const auto lobe = [nanometres = wavelength * 1e9](
                      double height, double centre, double perBelow, double perAbove)
  {
    const double x = (nanometres - centre) * (nanometres < centre ? perBelow : perAbove);
    return height * std::exp(-0.5 * x * x);
  };
  return { lobe(1.056, 599.8, 0.0264, 0.0323) + lobe(0.362, 442.0, 0.0624, 0.0374) +
      lobe(-0.065, 501.1, 0.0490, 0.0382),
    lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
    lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725) };
}

/// XYZ, with light of equal energy at (1, 1, 1), to linear sRGB, where it is white: sRGB's primaries
/// (IEC 61966-2-1), Bradford's adaptation from illuminant E to D65.
constexpr std::array<Triple, 3> rgbFromXyz{ { { 3.14665765, -1.66646375, -0.48019390 },
  { -0.99552161, 1.95575673, 0.03976487 }, { 0.06359480, -0.21456322, 1.15096842 } } };

} // namespace

WhiteLight WhiteLight::of(
  double wavelength, const std::function<double(double)>& dispersion, const Carrier& carrier)
{
  constexpr double lowest = 1 / 780e-9, highest = 1 / 380e-9; // wavenumbers, 1 / metres
  constexpr double width = (highest - lowest) / bands;
  WhiteLight light{};
  light.minDispersion = light.maxDispersion = 1;
  // One more on either side, for differences.
  std::array<double, bands + 2> wavenumbers, turns;
  std::array<Triple, bands + 2> energies;
  for (std::size_t n = 0; n < wavenumbers.size(); ++n)
  {
    wavenumbers[n] = lowest + (static_cast<double>(n) - 0.5) * width;
    const double wavelengthHere = 1 / wavenumbers[n];
    const double factor = dispersion ? dispersion(wavelengthHere) : 1;
    if (!std::isfinite(factor))
    {
      throw Error("The gas's dispersion is not finite at a wavelength of " +
        std::to_string(std::lround(wavelengthHere * 1e9)) +
        " nm, so white light has no fringes. Choose an index model that covers 370 to 800 nm, or "
        "switch WhiteLight off.");
    }
    light.minDispersion = std::min(light.minDispersion, factor);
    light.maxDispersion = std::max(light.maxDispersion, factor);
    turns[n] = factor * wavenumbers[n];
    energies[n] = colorMatching(wavelengthHere);
    for (double& energy : energies[n])
    {
      energy *= wavelengthHere * wavelengthHere; // d wavelength / d wavenumber
    }
  }

  light.carrier = carrier;
  light.fadePerCarrier = static_cast<float>(wavelength * width);
  std::array<Triple, bands> xyz;
  Triple sum{ 0, 0, 0 };
  for (std::size_t band = 0; band < bands; ++band)
  {
    const std::size_t n = band + 1;
    light.turnsPerPath[band] = turns[n];
    light.turnsPerCarrier[band] = wavelength * wavenumbers[n];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // A spectrum that is linear between bands has fringes which fade too early; this makes up for it
      // to fourth order of a band's width.
      const double here = energies[n][axis];
      xyz[band][axis] = here - (energies[n - 1][axis] - 2 * here + energies[n + 1][axis]) / 12;
      sum[axis] += xyz[band][axis];
    }
  }
  for (std::size_t group = 0; group < groups; ++group)
  {
    const std::size_t first = group * perGroup + 1;
    const double change = turns[first + perGroup] - turns[first - 1];
    light.fadePerPath[group] = static_cast<float>(change / (perGroup + 1));
  }
  for (std::size_t channel = 0; channel < channels; ++channel)
  {
    const Triple& row = rgbFromXyz[channel];
    const double whole = row[0] + row[1] + row[2]; // 1, but for the rounding of the matrix
    for (std::size_t band = 0; band < bands; ++band)
    {
      const double fraction = row[0] * xyz[band][0] / sum[0] + row[1] * xyz[band][1] / sum[1] +
        row[2] * xyz[band][2] / sum[2];
      light.fraction[channel][band] = static_cast<float>(0.5 * fraction / whole);
    }
  }
  return light;
}

bool WhiteLightTable::canDo(const WhiteLight& light)
{
  // Of other gases, which are none, fringes would be wider or closer than the table is made for.
  return light.carrier.isNone() ? light.minDispersion > 0.8 && light.maxDispersion < 1.25
                                : light.minDispersion == 1 && light.maxDispersion == 1;
}

std::vector<float> WhiteLightTable::colorsOf(WhiteLight light)
{
  light.carrier = {};
  std::vector<float> colors;
  colors.reserve(channels * places);
  for (int place = 0; place < places; ++place)
  {
    double color[channels];
    light.sum({ { 0, 0 }, place * (reach / (places - 1)), { 0, 0 } }, color);
    for (const double channel : color)
    {
      colors.push_back(static_cast<float>(channel));
    }
  }
  return colors;
}

} // namespace schlieren
