// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"
#include "Optics/BrightField.h"
#include "Optics/ColorFilter.h"
#include "Optics/Interferogram.h"
#include "Optics/KnifeEdge.h"
#include "Optics/NumericalSchlieren.h"
#include "Optics/Pattern.h"
#include "Optics/RayAtFilm.h"

#include <type_traits>
#include <variant>

namespace schlieren
{

/// No cutoff at all: every ray counts in full, and where rays land makes the image.
struct Shadowgraph
{
  static constexpr int channels = 1;

  SCHLIEREN_HD void shade(const RayAtFilm&, double (&light)[channels]) const { light[0] = 1; }
  SCHLIEREN_HD bool saturates(const double (&)[2]) const { return false; }
};

/// All that there are. Each turns a ray into light, 0 ... 1 in each of its channels: one, or linear red,
/// green and blue.
using Cutoffs = std::variant<KnifeEdge, Shadowgraph, BrightField, DarkField, GradedFilter,
  ColorWheel, ColorImage, Interferogram, Dots, Stripes, BackgroundImage, NumericalSchlieren>;

inline int channelsOf(const Cutoffs& cutoff)
{
  return std::visit([](const auto& kind) { return kind.channels; }, cutoff);
}

/// Where a kind keeps its table, null if it has none.
inline Table* tableOf(GradedFilter& kind) { return &kind.table; }
inline Table* tableOf(ColorWheel& kind) { return &kind.linear; }
inline Table* tableOf(ColorImage& kind) { return &kind.linear; }
inline Table* tableOf(BackgroundImage& kind) { return &kind.image.linear; }
template <class Kind>
Table* tableOf(Kind&)
{
  return nullptr;
}

/// Light that nothing bends; where a carrier makes fringes of it, and of a pattern, the mean. Of colours the
/// luminance.
double undisturbedLevel(const Cutoffs& cutoff);

} // namespace schlieren
