// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ReferenceTracer.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace schlieren::reference
{

/// Of coefficients -1 ... 2 from a point: the weights of the B-spline at t from there, and their derivatives. Linear and Cubic: for
/// t from 0 to 1; Quadratic: from -1/2 to 1/2.
struct Weights
{
  std::array<Real, 4> value, slope;
};
inline Weights weightsAt(Interpolation interpolation, Real t)
{
  const Real s = 1 - t, a = t - 0.5L, b = t + 0.5L;
  switch (interpolation)
  {
    case Interpolation::Linear:
      return { { 0, s, t, 0 }, { 0, -1, 1, 0 } };
    case Interpolation::Quadratic:
      return { { a * a / 2, 0.75L - t * t, b * b / 2, 0 }, { a, -2 * t, b, 0 } };
    case Interpolation::Cubic:
      return { { s * s * s / 6, 2 / 3.0L - t * t * (2 - t) / 2, 2 / 3.0L - s * s * (2 - s) / 2,
                 t * t * t / 6 },
        { -s * s / 2, t * (3 * t - 4) / 2, -s * (3 * s - 4) / 2, t * t / 2 } };
    case Interpolation::Central:
      break;
  }
  throw std::invalid_argument("no spline");
}

/// The n + 2 coefficients of the spline through n samples, one beyond either end, where they continue as the polynomial of the
/// spline's degree through the last of them. Gauss and Seidel's iteration, relaxed at the ends.
inline std::vector<Real> coefficientsOf(
  const std::vector<Real>& samples, Interpolation interpolation)
{
  const std::array<Real, 4> w = weightsAt(interpolation, 0).value;
  const auto beyond = [&](Real a, Real b, Real c, Real d)
  {
    return interpolation == Interpolation::Linear ? 2 * a - b
      : interpolation == Interpolation::Quadratic ? 3 * a - 3 * b + c
                                                  : 4 * a - 6 * b + 4 * c - d;
  };
  const std::size_t n = samples.size();
  std::vector<Real> c(n + 2);
  for (int sweep = 0; sweep < 80; ++sweep)
  {
    for (std::size_t i = 1; i <= n; ++i)
    {
      c[i] = (samples[i - 1] - w[0] * c[i - 1] - w[2] * c[i + 1]) / w[1];
    }
    c[0] = (c[0] + beyond(c[1], c[2], c[3], c[4])) / 2;
    c[n + 1] = (c[n + 1] + beyond(c[n], c[n - 1], c[n - 2], c[n - 3])) / 2;
  }
  return c;
}

/// The spline (Linear, Quadratic or Cubic) through samples at the grid's points, x fastest.
inline Flow splineThrough(
  const Grid& grid, const std::vector<double>& samples, Interpolation interpolation, Real largest)
{
  const auto coefficients = std::make_shared<std::vector<Real>>(samples.begin(), samples.end());
  std::array<std::size_t, 3> size;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Lines along an axis become the slowest one, which leaves the next axis the fastest.
    const auto n = static_cast<std::size_t>(grid.dimensions[axis]);
    const std::size_t lines = coefficients->size() / n;
    size[axis] = n + 2;
    std::vector<Real> found(lines * (n + 2));
    for (std::size_t line = 0; line < lines; ++line)
    {
      const Real* first = coefficients->data() + line * n;
      const std::vector<Real> c = coefficientsOf({ first, first + n }, interpolation);
      for (std::size_t i = 0; i < n + 2; ++i)
      {
        found[i * lines + line] = c[i];
      }
    }
    *coefficients = found;
  }
  const auto valueAt = [=](const std::array<std::size_t, 3>& point, const Vec& index)
  {
    const std::size_t points = interpolation == Interpolation::Cubic ? 4 : 3;
    const Weights x = weightsAt(interpolation, index[0] - Real(point[0]));
    const Weights y = weightsAt(interpolation, index[1] - Real(point[1]));
    const Weights z = weightsAt(interpolation, index[2] - Real(point[2]));
    Value sum; // gradient by index coordinates
    for (std::size_t n = 0; n < points * points * points; ++n)
    {
      const std::size_t i = n % points, j = n / points % points, k = n / points / points;
      const Real c =
        (*coefficients)[point[0] + i + size[0] * (point[1] + j + size[1] * (point[2] + k))];
      sum.refractivity += c * x.value[i] * y.value[j] * z.value[k];
      sum.gradient[0] += c * x.slope[i] * y.value[j] * z.value[k];
      sum.gradient[1] += c * x.value[i] * y.slope[j] * z.value[k];
      sum.gradient[2] += c * x.value[i] * y.value[j] * z.slope[k];
    }
    return sum;
  };
  const auto pieceAt = [=](const Vec& place)
  {
    // Between points; of a quadratic spline around a point.
    const Real half = interpolation == Interpolation::Quadratic ? 0.5L : 0;
    Piece piece;
    std::array<std::size_t, 3> point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const Real last = Real(grid.dimensions[axis] - 1);
      const Real low = std::clamp(std::floor(place[axis] + half), Real(0), last - 1 + 2 * half);
      point[axis] = static_cast<std::size_t>(low);
      piece.low[axis] = std::max(low - half, Real(0));
      piece.high[axis] = std::min(low + 1 - half, last);
    }
    piece.valueAt = [=](const Vec& x)
    {
      const Value value = valueAt(point, indexOf(grid, x));
      Vec gradient{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        gradient = gradient +
          value.gradient[axis] / Real(grid.spacing[axis] * grid.spacing[axis]) * stepOf(grid, axis);
      }
      return Value{ value.refractivity, gradient };
    };
    return piece;
  };
  return { grid, pieceAt, largest };
}

} // namespace schlieren::reference
