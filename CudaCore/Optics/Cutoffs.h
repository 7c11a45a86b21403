// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Math/Units.h"
#include "Optics/RayAtFilm.h"

#include <cmath>
#include <variant>

namespace schlieren
{

/// Knife edge (Settles 2001, ch. 3: dI/I = f eps / a, k = f/a): I = 1/2 + k (eps . edge normal),
/// clamped to [0, 1]. Undisturbed light: 1/2.
struct KnifeEdge
{
  double k;         ///< focal length by source width, f/a
  double normal[2]; ///< (cos angle, sin angle)
  bool inverted;    ///< the knife cuts from the other side: I becomes 1 - I

  /// `degrees`: 0 measures the deflection along u, 90 along v. Exact at right angles, so that a knife
  /// along one axis sees nothing of the other.
  static KnifeEdge at(double degrees, double k, bool inverted)
  {
    const double turn = std::remainder(degrees, 360.0);
    const double cosine = std::abs(turn) == 90 ? 0 : std::cos(turn * radiansPerDegree);
    const double sine = std::abs(turn) == 180 ? 0 : std::sin(turn * radiansPerDegree);
    return { k, { cosine, sine }, inverted };
  }

  static constexpr int channels = 1;

  SCHLIEREN_HD void shade(const RayAtFilm& ray, double (&light)[channels]) const
  {
    const double along = ray.deflection[0] * normal[0] + ray.deflection[1] * normal[1];
    const double change = inverted ? -k * along : k * along;
    const double passed = 0.5 + change;
    light[0] = passed > 0 ? (passed < 1 ? passed : 1) : 0;
  }
};

/// No cutoff at all: every ray counts in full, and where rays land makes the picture.
/// Undisturbed light: 1.
struct Shadowgraph
{
  static constexpr int channels = 1;

  SCHLIEREN_HD void shade(const RayAtFilm&, double (&light)[channels]) const { light[0] = 1; }
};

/// Any of the above. Each gives a ray's light, 0 ... 1, of one channel or of three: linear red, green, blue.
using Cutoffs = std::variant<KnifeEdge, Shadowgraph>;

inline int channelsOf(const Cutoffs& cutoff)
{
  return std::visit([](const auto& kind) { return kind.channels; }, cutoff);
}

} // namespace schlieren
