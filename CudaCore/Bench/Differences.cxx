// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/Differences.h"

#include <algorithm>

namespace schlieren
{

double exceededBy(double part, Differences differences)
{
  std::sort(differences.begin(), differences.end(),
    [](const Difference& a, const Difference& b) { return a.value > b.value; });
  double all = 0;
  for (const Difference& one : differences)
  {
    all += one.pixels;
  }
  double above = 0;
  for (const Difference& one : differences)
  {
    above += one.pixels;
    if (above > part * all)
    {
      return one.value;
    }
  }
  return 0;
}

double largestOf(const Differences& differences)
{
  double largest = 0;
  for (const Difference& one : differences)
  {
    largest = std::max(largest, one.value);
  }
  return largest;
}

} // namespace schlieren
