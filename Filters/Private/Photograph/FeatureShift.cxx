// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photograph/FeatureShift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace filters
{

namespace
{

constexpr std::array<int, 4> levels{ 8, 4, 2, 1 };
constexpr int rounds = 3;            // of each level
constexpr double windowPoints = 6;   // standard deviation of a window, times the root of the level
constexpr float leastSquare = 1e-5f; // added to squared gradients: without features, nothing moves
constexpr float leastGradient = 0.01f; // of a feature, per point
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

template <class Value>
Plane made(const Plane& like, const Value& valueAt)
{
  Plane result(like.columns, like.rows);
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    result.values[i] = valueAt(i);
  }
  return result;
}

/// Returns a plane at its points moved by the shift.
Plane moved(const Plane& plane, const Plane& right, const Plane& up, float outside)
{
  const Lookup lookup(plane);
  Plane result(plane.columns, plane.rows);
  for (int row = 0; row < plane.rows; ++row)
  {
    for (int column = 0; column < plane.columns; ++column)
    {
      result(column, row) =
        lookup(double{ right(column, row) } + column, double{ up(column, row) } + row, outside);
    }
  }
  return result;
}

/// Returns a shrunk plane at as many points as `like` has, times `factor`.
Plane enlarged(const Plane& plane, int factor, const Plane& like)
{
  if (factor == 1)
  {
    return plane;
  }
  const Lookup lookup(plane);
  Plane result(like.columns, like.rows);
  const auto place = [factor](int index, int count)
  { return std::clamp((index + 0.5) / factor - 0.5, 0., count - 1.); };
  for (int row = 0; row < like.rows; ++row)
  {
    for (int column = 0; column < like.columns; ++column)
    {
      result(column, row) = static_cast<float>(factor) *
        lookup(place(column, plane.columns), place(row, plane.rows), 0);
    }
  }
  return result;
}

/// Whether a point is known with all that a window around it needs.
Plane wellKnown(const Plane& known)
{
  const Plane around = blurred(known, 5);
  return made(known,
    [&](std::size_t i) { return known.values[i] > 0.9f && around.values[i] > 0.98f ? 1.f : 0.f; });
}

/// Improves the shift by one round at one level.
void refine(const Plane& simulated, const Plane& photograph, const Plane& known, double window,
  Plane& right, Plane& up)
{
  const auto [slopeRight, slopeUp] = gradientOf(simulated);
  const Plane there = moved(photograph, right, up, 0);
  Plane weight = moved(known, right, up, 0);
  for (std::size_t i = 0; i < weight.size(); ++i)
  {
    weight.values[i] *= known.values[i];
  }
  const auto mean = [&](auto&& valueAt) { return blurred(made(weight, valueAt), window); };
  const auto& w = weight.values;
  const auto& gx = slopeRight.values;
  const auto& gy = slopeUp.values;
  const auto& p = there.values;
  const auto& m = simulated.values;
  const Plane sum = blurred(weight, window);
  const Plane offset = mean([&](std::size_t i) { return w[i] * (p[i] - m[i]); });
  const Plane rest = made(weight,
    [&](std::size_t i)
    { return w[i] * (p[i] - m[i] - offset.values[i] / std::max(sum.values[i], 1e-6f)); });
  const Plane xx = mean([&](std::size_t i) { return w[i] * gx[i] * gx[i]; });
  const Plane xy = mean([&](std::size_t i) { return w[i] * gx[i] * gy[i]; });
  const Plane yy = mean([&](std::size_t i) { return w[i] * gy[i] * gy[i]; });
  const Plane x = mean([&](std::size_t i) { return gx[i] * rest.values[i]; });
  const Plane y = mean([&](std::size_t i) { return gy[i] * rest.values[i]; });
  const auto solved = [&](const Plane& ofOwn, const Plane& own, const Plane& other)
  {
    return blurred(
      made(weight,
        [&](std::size_t i)
        {
          const float a = xx.values[i] + leastSquare, c = yy.values[i] + leastSquare;
          const float b = xy.values[i];
          return ((ofOwn.values[i] + leastSquare) * own.values[i] - b * other.values[i]) /
            (a * c - b * b);
        }),
      window);
  };
  const Plane toRight = solved(yy, x, y), upward = solved(xx, y, x);
  for (std::size_t i = 0; i < right.size(); ++i)
  {
    right.values[i] -= toRight.values[i];
    up.values[i] -= upward.values[i];
  }
}

} // namespace

FeatureShift shiftOfFeatures(const Plane& simulated, const Plane& photograph, const Plane& known)
{
  const int factor = std::max(1, simulated.columns / 400);
  const Plane model = shrunk(simulated, factor);
  const Plane weight = shrunk(
    made(known, [&](std::size_t i) { return known.values[i] > 0.999f ? 1.f : 0.f; }), factor);
  const Plane values =
    shrunk(made(photograph,
             [&](std::size_t i)
             { return known.values[i] > 0.999f ? photograph.values[i] : simulated.values[i]; }),
      factor);
  Plane right(model.columns, model.rows), up(model.columns, model.rows);
  for (const int level : levels)
  {
    const Plane coarse = blurred(model, 0.5 * level), seen = blurred(values, 0.5 * level);
    for (int round = 0; round < rounds; ++round)
    {
      refine(coarse, seen, weight, windowPoints * std::sqrt(level), right, up);
    }
  }

  const auto [slopeRight, slopeUp] = gradientOf(blurred(model, 1));
  const Plane isKnown = wellKnown(weight);
  Plane acrossRight = made(model, [](std::size_t) { return unknown; }), acrossUp = acrossRight;
  for (std::size_t i = 0; i < model.size(); ++i)
  {
    const float gx = slopeRight.values[i], gy = slopeUp.values[i];
    const float square = gx * gx + gy * gy;
    if (isKnown.values[i] > 0 && square > leastGradient * leastGradient)
    {
      const float across = (right.values[i] * gx + up.values[i] * gy) / square;
      acrossRight.values[i] = across * gx;
      acrossUp.values[i] = across * gy;
    }
  }
  return { enlarged(right, factor, simulated), enlarged(up, factor, simulated),
    enlarged(acrossRight, factor, simulated), enlarged(acrossUp, factor, simulated) };
}

Exposure pulledBack(const Exposure& exposure, const FeatureShift& shift)
{
  const auto pulled = [&](const Plane& plane, float outside)
  { return plane.values.empty() ? Plane() : moved(plane, shift.right, shift.up, outside); };
  Plane known = pulled(exposure.known, 0);
  for (std::size_t i = 0; i < known.size(); ++i)
  {
    known.values[i] = known.values[i] > 0.999f && exposure.known.values[i] > 0 ? 1.f : 0.f;
  }
  return { pulled(exposure.photograph, unknown), pulled(exposure.withoutFlow, unknown),
    wellKnown(known) };
}

} // namespace filters
