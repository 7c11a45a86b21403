// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Tree/LineErrors.h"

#include "Medium/Tree/Brick.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace schlieren
{

namespace
{

constexpr int edge = BrickMaker<float>::edge;
constexpr int padded = edge + 2;

/// Sums along lines up to each place of a layer, with zeros around it.
using Sums = std::array<std::array<float, padded>, padded>;

struct Found
{
  float largest = 0;
  double meanSquare = 0;
};

/// In double precision: squares of what the faintest media have are less than the least float.
double sumOfSquares(const float* first, const float* last)
{
  return std::accumulate(first, last, 0.,
    [](double sum, float value)
    { return sum + static_cast<double>(value) * static_cast<double>(value); });
}

/// Sums from where a line enters the brick; the mean square is that of whole lines.
Found sumsAlong(const std::array<int, 3>& step, const std::vector<float>& errors, int layers)
{
  Sums sums[2] = {};
  std::array<float, edge> most{};
  double squares = 0;
  int lines = 0;
  const float* next = errors.data();
  for (int k = 0; k < layers; ++k)
  {
    Sums& now = sums[k % 2];
    const Sums& before = step[2] != 0 ? sums[(k + 1) % 2] : now;
    for (int j = 0; j < edge; ++j, next += edge)
    {
      const auto row = static_cast<std::size_t>(j + 1);
      const float* from = before[static_cast<std::size_t>(j + 1 - step[1])].data() + (1 - step[0]);
      float* to = now[row].data() + 1;
      for (std::size_t i = 0; i < edge; ++i)
      {
        to[i] = next[i] + from[i];
        most[i] = std::max(most[i], std::abs(to[i]));
      }
      const bool isLast =
        (step[2] != 0 && k + 1 == layers) || (step[1] != 0 && j == (step[1] > 0 ? edge - 1 : 0));
      const int ends = isLast ? edge : step[0] != 0 ? 1 : 0;
      const int firstEnd = !isLast && step[0] > 0 ? edge - 1 : 0;
      squares += sumOfSquares(to + firstEnd, to + firstEnd + ends);
      lines += ends;
    }
  }
  return { *std::max_element(most.begin(), most.end()), squares / lines };
}

/// Which line it is.
std::size_t numberOf(const std::array<int, 3>& direction)
{
  std::array<int, 3> opposite = direction;
  std::transform(direction.begin(), direction.end(), opposite.begin(), [](int d) { return -d; });
  const auto found = std::find_if(lineDirections.begin(), lineDirections.end(),
    [&](const auto& line) { return line == direction || line == opposite; });
  return static_cast<std::size_t>(found - lineDirections.begin());
}

} // namespace

void LineErrors::scale(float factor)
{
  for (ByDirection* errors : { &this->largest, &this->typical, &this->largestAtEdges })
  {
    for (std::array<float, 3>& ofLine : *errors)
    {
      for (float& ofAxis : ofLine)
      {
        ofAxis *= factor;
      }
    }
  }
}

LineErrors::Error LineErrors::along(
  const Vec3<double>& direction, const std::array<bool, 3>& counts) const
{
  const std::array<double, 3> d{ direction.x, direction.y, direction.z };
  std::array<std::size_t, 3> order{ 0, 1, 2 };
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return std::abs(d[a]) > std::abs(d[b]); });
  const double most = std::abs(d[order[0]]);
  Error error{ 0, 0, 0 };
  std::array<int, 3> line{ 0, 0, 0 };
  for (std::size_t n = 0; n < 3; ++n)
  {
    const std::size_t added = order[n];
    line[added] = d[added] < 0 ? -1 : 1;
    const double rest = n < 2 ? std::abs(d[order[n + 1]]) : 0;
    const double share = most > 0 ? (std::abs(d[added]) - rest) / most : 0;
    if (!(share > 0))
    {
      continue;
    }
    const std::size_t number = numberOf(line);
    double ofGas = 0, ofEdges = 0, square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (counts[axis])
      {
        ofGas = std::max(ofGas, static_cast<double>(this->largest[number][axis]));
        ofEdges = std::max(ofEdges, static_cast<double>(this->largestAtEdges[number][axis]));
        const auto typicalOfAxis = static_cast<double>(this->typical[number][axis]);
        square += typicalOfAxis * typicalOfAxis;
      }
    }
    error.largest += share * ofGas;
    error.largestAtEdges += share * ofEdges;
    error.typical += share * std::sqrt(square);
  }
  return error;
}

void addLines(const std::vector<float>& errors, std::size_t axis, BrickShape shape,
  const std::array<double, 3>& voxel, GradientsOf which, LineErrors& to)
{
  const bool isLayer = shape == BrickShape::Layer;
  for (std::size_t line = 0; line < lineDirections.size(); ++line)
  {
    const std::array<int, 3>& step = lineDirections[line];
    Found found;
    double factor = 0;
    if (isLayer && step[2] != 0)
    {
      for (const float error : errors)
      {
        found.largest = std::max(found.largest, std::abs(error));
      }
      found.meanSquare = sumOfSquares(errors.data(), errors.data() + errors.size()) / (edge * edge);
      factor = edge * std::max(voxel[0], voxel[1]) / voxel[axis];
    }
    else
    {
      std::array<double, 3> way{};
      for (std::size_t along = 0; along < 3; ++along)
      {
        way[along] = step[along] * voxel[along];
      }
      const double square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
      // The gradient along a ray does not bend it; rays through layers are steep.
      factor = std::sqrt(square - (isLayer ? 0 : way[axis] * way[axis])) / voxel[axis];
      found = factor > 0 ? sumsAlong(step, errors, isLayer ? 1 : edge) : found;
    }
    LineErrors::ByDirection& ofMost = which == GradientsOf::Gas ? to.largest : to.largestAtEdges;
    float& largest = ofMost[line][axis];
    largest = std::max(largest, static_cast<float>(factor) * found.largest);
    if (which == GradientsOf::Gas)
    {
      float& typical = to.typical[line][axis];
      typical = std::max(typical, static_cast<float>(factor * std::sqrt(found.meanSquare)));
    }
  }
}

} // namespace schlieren
