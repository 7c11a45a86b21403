// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/HostDevice.h"

#include <cstddef>
#include <cstdint>

namespace schlieren
{

/// Numbers that a cutoff looks up. Their memory belongs to others: CutoffMaker or, on a device, the film.
struct Table
{
  const float* values;
  std::size_t size;
};

/// Between the numbers of a table that are evenly spaced from 0 to 1, at least 2 of them; the ends are
/// continued.
SCHLIEREN_HD double interpolate(const Table& table, double place)
{
  const double last = static_cast<double>(table.size - 1);
  const double at = place > 0 ? (place < 1 ? place * last : last) : 0; // of NaN: 0
  const auto left = static_cast<std::int64_t>(at < last ? at : last - 1);
  const double low = static_cast<double>(table.values[left]);
  const double high = static_cast<double>(table.values[left + 1]);
  return low + (at - static_cast<double>(left)) * (high - low);
}

} // namespace schlieren
