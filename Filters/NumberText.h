// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef NumberText_h
#define NumberText_h

#include <cmath>
#include <cstdio>
#include <string>

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

namespace filters
{

/// Returns a number in words, by a format of printf with one %f, %g or %e.
inline std::string textOf(const char* format, double value)
{
  char text[512]; // 1e308 in full, and words
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Returns a number with so many significant digits.
inline std::string textOf(double value, int digits = 6)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// Returns a length with so many significant digits, in a unit that suits it.
inline std::string lengthInWords(double metres, int digits)
{
  const UnitPrefix prefix = unitPrefixOf(metres);
  return textOf(metres / prefix.factor, digits) + " " + prefix.name + "m";
}

} // namespace filters

#endif
