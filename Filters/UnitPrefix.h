// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef UnitPrefix_h
#define UnitPrefix_h

#include <cmath>

/// A prefix of a unit: its name in UTF-8, and what a value is divided by.
struct UnitPrefix
{
  double factor;
  const char* name;
};

/// Returns the prefix, from nano to kilo, with which a value has one to three digits before the point; milli for 0.
inline UnitPrefix unitPrefixOf(double value)
{
  constexpr UnitPrefix prefixes[] = { { 1e3, "k" }, { 1, "" }, { 1e-3, "m" },
    { 1e-6, "\xC2\xB5" } };
  for (const UnitPrefix& prefix : prefixes)
  {
    if (std::abs(value) >= prefix.factor)
    {
      return prefix;
    }
  }
  return value == 0 ? prefixes[2] : UnitPrefix{ 1e-9, "n" };
}

#endif
