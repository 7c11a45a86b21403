// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Math/Trigonometry.h"
#include "Math/Units.h"
#include "Optics/BrightField.h"
#include "Optics/Color.h"
#include "Optics/RayAtFilm.h"
#include "Optics/Table.h"

#include <cmath>

namespace schlieren
{

/// The colour wheel (Brownlee et al. 2011, eq. 17): hue atan2(eps_v, eps_u) with red at 0, yellow at 60 and
/// green at 120 degrees; saturation min(1, k |eps|); value 1; taken as sRGB.
struct ColorWheel
{
  static constexpr int channels = 3;

  double k;
  Table linear; ///< of sRGB values evenly spaced from 0 to 1

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    const double saturation = limited(distanceFromAxis(k, ray.deflection));
    const double sixths = angleOf(ray.deflection[0], ray.deflection[1]) * (3 / pi); // -3 ... 3
    const double red = limited(2 - fabs(sixths));
    const double green = limited(2 - fabs(sixths < -1 ? sixths + 4 : sixths - 2));
    const double blue = limited(2 - fabs(sixths > 1 ? sixths - 4 : sixths + 2));
    light[0] = interpolate(linear, 1 - saturation * (1 - red));
    light[1] = interpolate(linear, 1 - saturation * (1 - green));
    light[2] = interpolate(linear, 1 - saturation * (1 - blue));
  }
  SCHLIEREN_HD bool saturates(const double (&eps)[2]) const { return distanceFromAxis(k, eps) > 1; }
};

/// An image in the cutoff plane, whose edges are where a component of k eps is -1 or 1. Linear between the
/// centres of its pixels; beyond them the colour of the edge.
struct ColorImage
{
  static constexpr int channels = 3;

  double k;
  int width, height;
  Table linear; ///< linear red, green and blue of each pixel, row by row, bottom row first

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    const Between column = between(k * ray.deflection[0], width);
    const Between row = between(k * ray.deflection[1], height);
    const float* lower = linear.values + 3 * static_cast<std::int64_t>(width) * row.first;
    const float* upper = linear.values + 3 * static_cast<std::int64_t>(width) * row.second;
    for (int channel = 0; channel < channels; ++channel)
    {
      const auto along = [&](const float* pixels)
      {
        const double left = static_cast<double>(pixels[3 * column.first + channel]);
        const double right = static_cast<double>(pixels[3 * column.second + channel]);
        return left + column.fraction * (right - left);
      };
      const double low = along(lower);
      light[channel] = low + row.fraction * (along(upper) - low);
    }
  }
  SCHLIEREN_HD bool saturates(const double (&eps)[2]) const
  {
    return fabs(k * eps[0]) > 1 || fabs(k * eps[1]) > 1;
  }

private:
  /// Two neighbouring pixels of a row or column, and the fraction of the distance between their centres.
  struct Between
  {
    std::int64_t first, second;
    double fraction;
  };

  SCHLIEREN_HD static Between between(double place, int size)
  {
    const double last = size - 1;
    const double at = (place + 1) / 2 * size - 0.5;
    const double inside = at > 0 ? (at < last ? at : last) : 0; // of NaN: 0
    const auto first = static_cast<std::int64_t>(inside);
    return { first, first < size - 1 ? first + 1 : first, inside - static_cast<double>(first) };
  }
};

} // namespace schlieren
