// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

namespace schlieren
{

/// Returns a number for a message: six digits, whatever its size.
inline std::string textOf(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

} // namespace schlieren
