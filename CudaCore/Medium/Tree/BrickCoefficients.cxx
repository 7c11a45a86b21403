// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Tree/BrickCoefficients.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

double larger(double a, double b) { return a > b ? a : b; }
double smaller(double a, double b) { return a < b ? a : b; }

/// How far a coefficient is beyond a sample and those beside it.
double beyondSamples(const double* at, std::ptrdiff_t stride, double coefficient)
{
  const double a = at[-stride], b = at[0], c = at[stride];
  return larger(coefficient - larger(larger(a, b), c), smaller(smaller(a, b), c) - coefficient);
}

/// The second difference at a sample, as far as it is not the foot of a front: where it is flat on one side, or bent the
/// opposite direction. There the spline would overshoot, by up to 7 % of a jump over one cell. At the maximum of a smooth field
/// it is bent likewise beside it, or steep (maxima are found by such minima of curvatures in Colella & Sekora 2008).
double smoothBend(const double* at, std::ptrdiff_t stride)
{
  const double bend = at[-stride] - 2 * at[0] + at[stride];
  const auto onSide = [&](std::ptrdiff_t s)
  {
    const double next = at[0] - 2 * at[s] + at[2 * s];
    return 2 * larger(std::abs(at[s] - at[0]), next * bend > 0 ? std::abs(next) : 0);
  };
  return smaller(std::abs(bend), smaller(onSide(-stride), onSide(stride)));
}

/// A coefficient that is no farther beyond a sample and those beside it than this.
double limited(const double* at, std::ptrdiff_t stride, double coefficient, double beyond)
{
  const auto [lowest, highest] = std::minmax({ at[-stride], at[0], at[stride] });
  return std::clamp(coefficient, lowest - beyond, highest + beyond);
}

} // namespace

bool makeCoefficients(BrickSamples& samples, const CoefficientRule& rule)
{
  const int n = samples.n;
  const double outer = -rule.outer;
  const double inner = 1 - 2 * outer;
  const std::array<int, 3> strides{ 1, n, n * n };
  const int skipped = samples.margin - rule.apron;
  std::array<int, 3> low{ 0, 0, 0 },
    high{ n, n, samples.layers }; // where samples are what they should be
  std::vector<double> line(samples.nu.size());
  for (std::size_t axis = 0; axis < rule.axes; ++axis)
  {
    // Along the axis, the outermost layers come out wrong: none is stored.
    low[axis] = skipped;
    high[axis] = n - skipped;
    const auto s = static_cast<std::ptrdiff_t>(strides[axis]);
    for (int k = low[2]; k < high[2]; ++k)
    {
      for (int j = low[1]; j < high[1]; ++j)
      {
        const std::size_t row = samples.index(low[0], j, k);
        const double* from = samples.nu.data() + row;
        double* to = line.data() + row;
        const int count = high[0] - low[0];
        std::int64_t fronts = 0;
        for (int i = 0; i < count; ++i)
        {
          to[i] = inner * from[i] + outer * (from[i - s] + from[i + s]);
          fronts += beyondSamples(from + i, s, to[i]) > rule.overshoot ? 1 : 0;
        }
        for (int i = 0; fronts > 0 && i < count; ++i)
        {
          if (!(beyondSamples(from + i, s, to[i]) > rule.overshoot))
          {
            continue;
          }
          const int along = std::array{ low[0] + i, j, k }[axis];
          if (along < supportOfFronts || along >= n - supportOfFronts)
          {
            return false;
          }
          to[i] =
            limited(from + i, s, to[i], larger(rule.overshoot, -outer * smoothBend(from + i, s)));
        }
      }
    }
    std::swap(line, samples.nu);
  }
  return true;
}

} // namespace schlieren
