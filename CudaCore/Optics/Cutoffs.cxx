// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/Cutoffs.h"

namespace schlieren
{

namespace
{

const Carrier* carrierOf(const Interferogram& kind) { return &kind.carrier; }
const Carrier* carrierOf(const WhiteLight& kind) { return &kind.carrier; }
const Carrier* carrierOf(const WhiteLightTable& kind) { return &kind.carrier; }
template <class Kind>
const Carrier* carrierOf(const Kind&)
{
  return nullptr;
}

} // namespace

double undisturbedLevel(const Cutoffs& cutoff)
{
  return std::visit(
    [](const auto& kind)
    {
      const Carrier* carrier = carrierOf(kind);
      if (carrier != nullptr && !carrier->isNone())
      {
        return 0.5;
      }
      double light[std::decay_t<decltype(kind)>::channels];
      kind.shade(RayAtFilm{ { 0, 0 }, 0, { 0, 0 } }, light);
      return luminanceOf(light);
    },
    cutoff);
}

} // namespace schlieren
