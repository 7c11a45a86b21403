// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Prefilter.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// Gives the points of `empty` (one bit per sample, as in MediumView) the mean of those neighbours
/// that have a value already, layer after layer, outward from the gas. Gas keeps its values; next to
/// a body in uniform gas there is no gradient.
template <class Real>
void fillEmpty(PaddedVolume<Real>& volume, std::vector<std::uint32_t> empty);

inline bool bitAt(const std::vector<std::uint32_t>& bits, std::int64_t at)
{
  return ((bits[static_cast<std::size_t>(at >> 5)] >> (at & 31)) & 1u) != 0;
}

inline void setBit(std::vector<std::uint32_t>& bits, std::int64_t at, bool value)
{
  const std::uint32_t bit = 1u << (at & 31);
  std::uint32_t& word = bits[static_cast<std::size_t>(at >> 5)];
  word = value ? word | bit : word & ~bit;
}

} // namespace schlieren
