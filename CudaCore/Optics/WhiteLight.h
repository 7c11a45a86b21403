// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Math/Trigonometry.h"
#include "Math/Units.h"
#include "Optics/Color.h"
#include "Optics/Interferogram.h"
#include "Optics/RayAtFilm.h"
#include "Optics/Table.h"

#include <cmath>
#include <functional>
#include <vector>

namespace schlieren
{

/// An interferogram in white light: the sum over bands of wavenumbers s = 1 / wavelength, 380 ... 780 nm, of
/// equal energy per wavelength. A band's light falls linearly to nothing at the middle of its neighbours;
/// over it the phase is linear, so that its fringes fade by sinc^2(w), where w is by how many turns the
/// phase grows from a band to the next one.
struct WhiteLight
{
  static constexpr int channels = 3;
  static constexpr int perGroup = 4; ///< bands that fade alike
  static constexpr int groups = 10;
  static constexpr int bands = groups * perGroup;

  double turnsPerPath[bands];    ///< dispersion / wavelength, 1 / metres
  double turnsPerCarrier[bands]; ///< by wavelength, of turns at Scene::wavelength
  float fadePerPath[groups];     ///< w of a metre
  float fadePerCarrier;          ///< w of a turn at Scene::wavelength
  float fraction[channels]
                [bands]; ///< of all light, linear sRGB; they add up to 1 / 2, and some are negative
  Carrier carrier;       ///< at Scene::wavelength
  double minDispersion, maxDispersion;

  /// `dispersion`: see Fringes; may be empty. Throws Error where it gives no number.
  static WhiteLight of(
    double wavelength, const std::function<double(double)>& dispersion, const Carrier& carrier);

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    sum(ray, light);
    for (double& channel : light)
    {
      channel = limited(channel);
    }
  }

  /// Light that may be less than 0 or more than 1, as the purest colours are.
  SCHLIEREN_HD void sum(const RayAtFilm& ray, double (&light)[channels]) const
  {
    // Loops that compilers turn into ones over packs of four, and the same order of sums everywhere.
    const double shift = carrier.turnsAt(ray.position);
    const float path = static_cast<float>(ray.path);
    const float tilt = static_cast<float>(shift);
    float contrasts[groups];
    for (int group = 0; group < groups; ++group)
    {
      contrasts[group] = squaredSinc(fadePerPath[group] * path + fadePerCarrier * tilt);
    }
    float turns[bands];
    for (int band = 0; band < bands; ++band)
    {
      const double phase = ray.path * turnsPerPath[band] + shift * turnsPerCarrier[band];
      turns[band] = static_cast<float>(phase - ((phase + wholes) - wholes));
    }
    float fringes[bands];
    for (int group = 0; group < groups; ++group)
    {
      for (int band = group * perGroup; band < (group + 1) * perGroup; ++band)
      {
        const float sine = turns[band] * sinPiByX(turns[band]);
        fringes[band] = contrasts[group] * (1 - 2 * sine * sine); // ... cos(2 pi turns)
      }
    }
    for (int channel = 0; channel < channels; ++channel)
    {
      float sums[perGroup] = {};
      for (int group = 0; group < groups; ++group)
      {
        for (int n = 0; n < perGroup; ++n)
        {
          const int band = group * perGroup + n;
          sums[n] += fraction[channel][band] * fringes[band];
        }
      }
      light[channel] = 0.5 + static_cast<double>((sums[0] + sums[1]) + (sums[2] + sums[3]));
    }
  }
  SCHLIEREN_HD bool saturates(const double (&)[2]) const { return false; }

private:
  /// (sin(pi x) / (pi x))^2.
  SCHLIEREN_HD static float squaredSinc(float x)
  {
    constexpr float perPi = static_cast<float>(1 / pi);
    constexpr float most = 1e6f; // where nothing is left; still has a fraction
    const float within = x > -most && x < most ? x : most;
    const float fraction = within - ((within + wholesOfFloat) - wholesOfFloat);
    const float sinc = sinPiByX(fraction) * perPi * (fraction == within ? 1 : fraction / within);
    return sinc * sinc;
  }
};

/// The same at a tenth of the cost, where the colour depends on one length only: without a carrier, or without
/// dispersion.
struct WhiteLightTable
{
  static constexpr int channels = 3;
  static constexpr int places = 5001;
  static constexpr double reach = 25e-6; ///< of the table, metres; fringes have faded there

  /// Unlimited light at evenly spaced paths from 0 to reach: the other side is the same.
  Table colors;
  Carrier carrier;
  double wavelength; ///< Scene::wavelength, the path of a turn of the carrier

  static bool canDo(const WhiteLight& light);

  /// The colours of a light without its carrier.
  static std::vector<float> colorsOf(WhiteLight light);

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    const double path = fabs(ray.path + carrier.turnsAt(ray.position) * wavelength);
    const double at = path * ((places - 1) / reach);
    const bool isFringe = at < places - 1; // not of NaN
    const int first = isFringe ? static_cast<int>(at) : 0;
    const double fraction = at - first;
    const float* color = colors.values + channels * first;
    for (int channel = 0; channel < channels; ++channel)
    {
      const double here = static_cast<double>(color[channel]);
      const double next = static_cast<double>(color[channel + channels]);
      light[channel] = isFringe ? limited(here + fraction * (next - here)) : 0.5;
    }
  }
  SCHLIEREN_HD bool saturates(const double (&)[2]) const { return false; }
};

} // namespace schlieren
