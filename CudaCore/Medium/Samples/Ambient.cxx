// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Samples/Ambient.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace schlieren
{

namespace
{

constexpr double asOne = 0.003; // of the range
constexpr double leastShare = 0.25;
constexpr double leastRatio = 2;  // to the share of any other value
constexpr int mostTenths = 6;     // of that
constexpr double rounding = 1e-9; // of sums in any order

using Values = std::vector<WeightedValue>;

/// Sorted values from `begin` on, up to `end`.
struct Run
{
  std::size_t begin, end;
  double weight;
};

/// Returns the run of values within a width that has most weight, of those in a run and nowhere nearer than the width to
/// another one.
Run heaviest(const Values& sorted, double width, const Run& in, const Run& other = { 0, 0, 0 })
{
  Run best{ in.begin, in.begin, 0 };
  Run run = best;
  while (run.end < in.end)
  {
    const double value = sorted[run.end].value;
    const bool isNear = other.weight > 0 && value >= sorted[other.begin].value - width &&
      value <= sorted[other.end - 1].value + width;
    run.weight += sorted[run.end++].weight;
    run = isNear ? Run{ run.end, run.end, 0 } : run;
    while (run.begin < run.end && value - sorted[run.begin].value > width)
    {
      run.weight -= sorted[run.begin++].weight;
    }
    best = run.weight > best.weight ? run : best;
  }
  return best;
}

/// Returns the first value of a run up to which half of the weight lies.
double medianOf(const Values& sorted, const Run& run)
{
  double below = 0;
  std::size_t at = run.begin;
  for (; at + 1 < run.end; ++at)
  {
    below += sorted[at].weight;
    if (below >= (0.5 - rounding) * run.weight)
    {
      break;
    }
  }
  return sorted[at].value;
}

/// Sorts values. Returns the run of all.
Run sorted(Values& values)
{
  std::sort(values.begin(), values.end(),
    [](const WeightedValue& a, const WeightedValue& b) { return a.value < b.value; });
  Run all{ 0, values.size(), 0 };
  for (const WeightedValue& one : values)
  {
    all.weight += one.weight;
  }
  return all;
}

} // namespace

double weightedMedian(Values values)
{
  const Run all = sorted(values);
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : medianOf(values, all);
}

double ambientOf(Values values)
{
  if (values.empty())
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Run all = sorted(values);
  const double width = asOne * (values.back().value - values.front().value);
  Run run = heaviest(values, width, all);
  const Run second = heaviest(values, width, all, run);
  if (run.weight < leastShare * all.weight || run.weight < leastRatio * second.weight)
  {
    return medianOf(values, all);
  }
  for (int tenths = 1; tenths <= mostTenths; ++tenths)
  {
    const Run narrower = heaviest(values, width * std::pow(0.1, tenths), run);
    run = narrower.weight >= 0.5 * run.weight ? narrower : run;
  }
  return medianOf(values, run);
}

} // namespace schlieren
