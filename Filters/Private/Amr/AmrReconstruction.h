// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Amr/AmrLevels.h"

#include <array>
#include <cmath>
#include <limits>

namespace filters
{

/// Computes the mean over an interval from the means of five neighbouring cells of edge 1, by the
/// polynomial of fourth degree that has these means. It is conservative: subintervals of a cell
/// average to the cell's mean (as in Colella & Woodward 1984, equation 1.6).
struct Reconstruction
{
  std::array<double, 5> weights;

  /// The interval has the width `width`; `centre` is relative to that of the middle cell.
  Reconstruction(double centre, double width)
  {
    // Integrates to a fifth-degree polynomial through six faces; cell k adds to the faces behind
    // it.
    constexpr int faces = 6;
    this->weights.fill(0);
    for (int face = 0; face < faces; ++face)
    {
      double atEnd = 1, atBegin = 1;
      for (int other = 0; other < faces; ++other)
      {
        if (other != face)
        {
          atEnd *= (centre + width / 2 + 2.5 - other) / (face - other);
          atBegin *= (centre - width / 2 + 2.5 - other) / (face - other);
        }
      }
      for (int cell = 0; cell < face; ++cell)
      {
        this->weights[static_cast<std::size_t>(cell)] += (atEnd - atBegin) / width;
      }
    }
  }

  /// Returns the mean from the cells, left to right. Extrapolates NaN cells; NaN if the middle cell
  /// is. Sums differences, so that uniform values stay exactly uniform.
  double operator()(const std::array<double, 5>& cells) const
  {
    std::array<double, 4> step;
    for (std::size_t i = 0; i < 4; ++i)
    {
      step[i] = cells[i + 1] - cells[i];
    }
    const auto isKnown = [](double x) { return !std::isnan(x); };
    if (!isKnown(step[1]) && !isKnown(step[2]))
    {
      return cells[2]; // NaN, or alone
    }
    // Extrapolates linearly first, and by a parabola if a third cell is known.
    const bool hasLeft = isKnown(step[1]), hasRight = isKnown(step[2]);
    if (!hasLeft)
    {
      step[1] = isKnown(step[3]) ? 2 * step[2] - step[3] : step[2];
    }
    if (!hasRight)
    {
      step[2] = isKnown(step[0]) ? 2 * step[1] - step[0] : step[1];
    }
    if (!hasLeft || !isKnown(step[0]))
    {
      step[0] = 2 * step[1] - step[2];
    }
    if (!hasRight || !isKnown(step[3]))
    {
      step[3] = 2 * step[2] - step[1];
    }
    return cells[2] - this->weights[0] * (step[0] + step[1]) - this->weights[1] * step[1] +
      this->weights[3] * step[2] + this->weights[4] * (step[2] + step[3]);
  }
};

/// The lines of cells along one axis of a box: the cells of a line are `stride` apart, and as many
/// lines lie side by side.
struct LinesAlong
{
  LinesAlong(const Counts& cells, std::size_t axis)
    : stride(axis == 0 ? 1 : static_cast<std::ptrdiff_t>(cells[0]) * (axis == 2 ? cells[1] : 1))
    , count(static_cast<std::ptrdiff_t>(volume(cells)) / cells[axis])
  {
  }

  std::ptrdiff_t stride, count;
};

/// Replaces the cells along one axis of a box by means over intervals of `width` cells around
/// `middles`, relative to the first cell's centre. A mean is NaN if the cell of its middle is NaN
/// or outside; other means ignore such cells.
inline void resampleAxis(std::vector<double>& values, Counts& cells, std::size_t axis,
  const std::vector<double>& middles, double width)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const int n = cells[axis];
  const auto count = static_cast<std::ptrdiff_t>(middles.size());
  const LinesAlong lines(cells, axis);
  const std::ptrdiff_t stride = lines.stride;
  std::vector<double> result(static_cast<std::size_t>(lines.count * count));
  for (std::ptrdiff_t row = 0; row < lines.count / stride * count; ++row)
  {
    const double middle = middles[static_cast<std::size_t>(row % count)];
    const int cell = static_cast<int>(std::lround(std::clamp(middle, -1., n + 0.)));
    const Reconstruction mean(middle - cell, width);
    const double* line = values.data() + row / count * n * stride;
    for (std::ptrdiff_t k = 0; k < stride; ++k)
    {
      std::array<double, 5> around;
      for (int i = 0; i < 5; ++i)
      {
        const int at = cell + i - 2;
        around[static_cast<std::size_t>(i)] = at < 0 || at >= n ? nan : line[at * stride + k];
      }
      result[static_cast<std::size_t>(row * stride + k)] = mean(around);
    }
  }
  values = std::move(result);
  cells[axis] = static_cast<int>(count);
}

/// A cubic spline through a row of cell means c; NaN: missing cells. Its coefficients are c less
/// 5/24 of their second differences, so that its means are c to fourth order. At shocks, where
/// third differences are not much smaller than first ones, second ones are omitted, which limits
/// overshoots to 1 % of the jump.
class SplineOfMeans
{
public:
  /// Sets another row, and reuses the memory.
  void set(const std::vector<double>& means)
  {
    this->Means = means;
    const int n = static_cast<int>(this->Means.size());
    this->Bends.resize(this->Means.size());
    const auto meanAt = [&](int i) { return at(this->Means, i); };
    for (int i = 0; i < n; ++i)
    {
      this->Bends[static_cast<std::size_t>(i)] = meanAt(i + 1) - 2 * meanAt(i) + meanAt(i - 1);
    }
    this->Coefficients.resize(this->Means.size());
    for (int i = 0; i < n; ++i)
    {
      double first = 0, third = 0; // largest differences
      for (int k = -2; k < 2; ++k)
      {
        first = larger(first, meanAt(i + k + 1) - meanAt(i + k));
      }
      for (int k = -1; k < 1; ++k)
      {
        third = larger(third, at(this->Bends, i + k + 1) - at(this->Bends, i + k));
      }
      constexpr double smooth = 0.35, rough = 0.8; // third by first differences
      const double part =
        first > 0 ? std::clamp((rough - third / first) / (rough - smooth), 0., 1.) : 0;
      // Copies the second difference of the neighbour beside missing cells.
      double bend = at(this->Bends, i);
      bend = std::isnan(bend) ? at(this->Bends, i - 1) : bend;
      bend = std::isnan(bend) ? at(this->Bends, i + 1) : bend;
      this->Coefficients[static_cast<std::size_t>(i)] =
        meanAt(i) - (std::isnan(bend) ? 0 : part * 5 / 24 * bend);
    }
  }

  /// Evaluates the spline relative to the first cell's centre. NaN in missing cells, which are
  /// extrapolated for others.
  double operator()(double place) const
  {
    const int n = static_cast<int>(this->Means.size());
    const int cell = static_cast<int>(std::lround(std::clamp(place, -1., n + 0.)));
    const double own = at(this->Coefficients, cell);
    if (std::isnan(own))
    {
      return own;
    }
    // Sums differences, so that uniform values stay exactly uniform.
    const int low = static_cast<int>(std::floor(place));
    const int farSide = low < cell ? -1 : 1; // where two coefficients count
    const auto stepTo = [&](int i) { return at(this->Coefficients, cell + i) - own; };
    double beside = stepTo(farSide), other = stepTo(-farSide);
    if (std::isnan(beside) && std::isnan(other))
    {
      return own;
    }
    if (std::isnan(other))
    {
      other = orElse(stepTo(2 * farSide) - 3 * beside, -beside);
    }
    if (std::isnan(beside))
    {
      beside = orElse(stepTo(-2 * farSide) - 3 * other, -other);
    }
    const double farthest = orElse(stepTo(2 * farSide), 3 * beside + other);
    const double t = farSide < 0 ? cell - place : place - cell; // 0 to 1/2
    return own + (1 - t) * (1 - t) * (1 - t) / 6 * other +
      (2. / 3 - (1 - t) * (1 - t) * (0.5 + 0.5 * t)) * beside + t * t * t / 6 * farthest;
  }

private:
  static double at(const std::vector<double>& values, int i)
  {
    return i < 0 || i >= static_cast<int>(values.size()) ? std::numeric_limits<double>::quiet_NaN()
                                                         : values[static_cast<std::size_t>(i)];
  }
  static double larger(double most, double x) { return std::abs(x) > most ? std::abs(x) : most; }
  static double orElse(double x, double other) { return std::isnan(x) ? other : x; }

  std::vector<double> Means, Bends, Coefficients; // bends: second differences
};

/// Replaces the cell means along one axis of a box by values at `places`; see SplineOfMeans.
inline void splineAxis(
  std::vector<double>& values, Counts& cells, std::size_t axis, const std::vector<double>& places)
{
  const LinesAlong lines(cells, axis);
  const std::size_t count = places.size();
  std::vector<double> result(static_cast<std::size_t>(lines.count) * count);
  std::vector<double> line(static_cast<std::size_t>(cells[axis]));
  SplineOfMeans spline;
  const auto stride = static_cast<std::size_t>(lines.stride);
  for (std::size_t row = 0; row < static_cast<std::size_t>(lines.count); ++row)
  {
    const std::size_t plane = row / stride, within = row % stride;
    for (std::size_t i = 0; i < line.size(); ++i)
    {
      line[i] = values[(plane * line.size() + i) * stride + within];
    }
    spline.set(line);
    for (std::size_t k = 0; k < count; ++k)
    {
      result[(plane * count + k) * stride + within] = spline(places[k]);
    }
  }
  values = std::move(result);
  cells[axis] = static_cast<int>(count);
}

} // namespace filters
