// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "UnitPrefix.h"

#include <cstdio>
#include <string>

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
