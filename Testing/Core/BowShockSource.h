// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// A blunt body with a bow shock, and straight rays through it.
#pragma once

#include "AnalyticSources.h"

namespace schlieren
{

/// A sphere of radius 1 with a bow shock, 0.03 thick, in a round domain of radius 50 with nothing around it. Cells
/// grow with the distance from the body and are fine in the shock.
class BowShockSource : public SphereSource
{
public:
  BowShockSource()
    : SphereSource(outer, 51.2)
  {
  }

  static constexpr double outer = 50, thickness = 0.03, far = 2.27e-4 * 1.2;

  double ambient() const override { return far; }
  double refractivity(double a, double b, double c) const override
  {
    return jump(shockDistance(a, b * b + c * c), radius(a, b, c));
  }
  Range rangeOver(const Box& box) const override
  {
    const Range s = shockDistances(box);
    const Range r = distancesTo({ 0, 0, 0 }, box);
    return { jump(s.second, r.second), jump(s.first, r.first) };
  }
  double cellSizeOver(const Box& box) const override
  {
    const Range s = shockDistances(box);
    const double r = distancesTo({ 0, 0, 0 }, box).first;
    const double ofShock =
      r < 8 && s.first < 3 * thickness && s.second > -3 * thickness ? 0.25 * thickness : 1e9;
    return std::min(ofShock, 0.02 * std::max(r, 1.));
  }
  std::array<double, 2> deflectionAt(
    const Vec3<double>& place, const Vec3<double>& u, const Vec3<double>& v) const
  {
    return summedUp(
      [](const Vec3<double>& at) -> Vec3<double>
      {
        const double r = length(at);
        const double t = std::tanh(shockDistance(at.x, at.y * at.y + at.z * at.z) / thickness);
        const double height = far / (1 + far) * 1.25 * std::exp(-(std::max(r, 1.) - 1) / 4);
        const double ofShock = -height * (1 - t * t) / thickness;
        const double ofFading = -height * (1 - t) / 4 / r;
        return ofShock * Vec3<double>{ 1, 0.4 * at.y, 0.4 * at.z } + ofFading * at;
      },
      place, u, v, 25, 2.5e-3, outer);
  }

private:
  static double shockDistance(double a, double squares) { return a - (1.4 - squares / 5); }
  static double jump(double s, double r)
  {
    return far * (1 + 1.25 * (1 - std::tanh(s / thickness)) * std::exp(-(std::max(r, 1.) - 1) / 4));
  }
  static Range shockDistances(const Box& box)
  {
    double least = 0, most = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
    {
      const double low = box.low[axis], high = box.high[axis];
      const double nearest = low > 0 ? low : high < 0 ? -high : 0;
      const double farthest = std::max(-low, high);
      least += nearest * nearest;
      most += farthest * farthest;
    }
    return { shockDistance(box.low[0], least), shockDistance(box.high[0], most) };
  }
};

} // namespace schlieren
