// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/Cutoffs.h"

#include <cstddef>
#include <optional>

namespace schlieren
{

namespace
{

const Carrier* carrierOf(const Interferogram& kind) { return &kind.carrier; }
template <class Kind>
const Carrier* carrierOf(const Kind&)
{
  return nullptr;
}

/// Light without the flow where it is not the same everywhere.
template <class Kind>
std::optional<double> meanOf(const Kind& kind)
{
  const Carrier* carrier = carrierOf(kind);
  const bool isFringed = carrier != nullptr && !carrier->isNone();
  return isFringed || std::is_same_v<Kind, Dots> || std::is_same_v<Kind, Stripes>
    ? std::optional(0.5)
    : std::nullopt;
}
std::optional<double> meanOf(const BackgroundImage& kind)
{
  const Table& table = kind.image.linear;
  double sum = 0;
  for (std::size_t i = 0; i + 2 < table.size; i += 3)
  {
    const double light[3] = { table.values[i], table.values[i + 1], table.values[i + 2] };
    sum += luminanceOf(light);
  }
  return 3 * sum / static_cast<double>(table.size);
}

} // namespace

double undisturbedLevel(const Cutoffs& cutoff)
{
  return std::visit(
    [](const auto& kind)
    {
      if (const std::optional<double> mean = meanOf(kind))
      {
        return *mean;
      }
      double light[std::decay_t<decltype(kind)>::channels];
      kind.shade(RayAtFilm{ { 0, 0 }, 0, { 0, 0 } }, light);
      return luminanceOf(light);
    },
    cutoff);
}

} // namespace schlieren
