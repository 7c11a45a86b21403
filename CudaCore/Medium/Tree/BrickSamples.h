// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Samples/MediumSource.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace schlieren
{

/// A lattice around a node.
struct BrickSamples
{
  int margin;                       ///< points beyond the node
  int n;                            ///< points along each axis
  int layers;                       ///< along z; 1: there is no margin either
  std::array<int, 3> begin, end;    ///< those that are within the domain
  std::vector<double> nu;           ///< everywhere, in the end
  std::vector<Place> places;        ///< only where there may be others than gas
  std::vector<float> distances;     ///< likewise
  std::vector<unsigned char> isGas; ///< empty: all are
  double lowest = std::numeric_limits<double>::infinity(); ///< nu of the gas
  double highest = -std::numeric_limits<double>::infinity();

  std::size_t index(int i, int j, int k) const
  {
    return static_cast<std::size_t>((k * n + j) * n + i);
  }
  bool isWithin(int i, int j, int k) const
  {
    return i >= begin[0] && i < end[0] && j >= begin[1] && j < end[1] &&
      (layers == 1 || (k >= begin[2] && k < end[2]));
  }
  /// Whether a neighbour along an axis, within the domain, is a window.
  bool isBesideWindow(int i, int j, int k) const
  {
    for (int axis = 0; axis < (layers > 1 ? 3 : 2); ++axis)
    {
      for (const int step : { -1, 1 })
      {
        const int a = i + (axis == 0 ? step : 0), b = j + (axis == 1 ? step : 0),
                  c = k + (axis == 2 ? step : 0);
        if (isWithin(a, b, c) && places[index(a, b, c)] == Place::Window)
        {
          return true;
        }
      }
    }
    return false;
  }
  std::array<int, 3> nearestWithin(std::array<int, 3> at) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      at[axis] = std::clamp(at[axis], begin[axis], std::max(begin[axis], end[axis] - 1));
    }
    return at;
  }
  bool isAllWithin() const
  {
    return begin == std::array<int, 3>{ 0, 0, 0 } && end == std::array<int, 3>{ n, n, layers };
  }
  bool hasGas() const { return lowest <= highest; }
  /// The steepest slope of nu at a point along an axis, a voxel; with what continues the gas.
  double slopeAt(int i, int j, int k) const
  {
    const double* at = &nu[index(i, j, k)];
    double steepest = 0;
    for (const std::ptrdiff_t stride : { 1, n, layers > 1 ? n * n : 0 })
    {
      steepest = std::max(steepest, 0.5 * std::abs(at[stride] - at[-stride]));
    }
    return steepest;
  }
  /// What linear interpolation of distances misses half a voxel away from a point: an eighth of second differences.
  float bendAt(int i, int j, int k) const
  {
    const float* at = &distances[index(i, j, k)];
    float sum = 0;
    for (const std::ptrdiff_t stride : { 1, n, layers > 1 ? n * n : 0 })
    {
      sum += std::abs(at[stride] - 2 * at[0] + at[-stride]);
    }
    return sum / 8;
  }
  /// The distance of a point such that linear interpolation between them, which would move what is curved towards its hollow
  /// side, has the right mean: less a twelfth of second differences.
  float distanceForLinear(const std::array<int, 3>& point) const
  {
    const float* at = &distances[index(point[0], point[1], point[2])];
    const std::ptrdiff_t strides[3] = { 1, n, n * n };
    float sum = 0;
    for (std::size_t axis = 0; axis < (layers > 1 ? 3 : 2); ++axis)
    {
      const bool hasBoth = point[axis] > begin[axis] && point[axis] + 1 < end[axis];
      sum += hasBoth ? at[strides[axis]] - 2 * at[0] + at[-strides[axis]] : 0;
    }
    return at[0] - sum / 12;
  }
  void addNormal(int i, int j, int k, std::array<std::array<float, 2>, 3>& normals) const
  {
    const float* at = &distances[index(i, j, k)];
    const std::ptrdiff_t strides[3] = { 1, n, layers > 1 ? n * n : 0 };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const float slope = (at[strides[axis]] - at[-strides[axis]]) / 2;
      normals[axis] = { std::min(normals[axis][0], slope), std::max(normals[axis][1], slope) };
    }
  }

  /// Gives values to all points.
  void fill();

private:
  /// Which points have a value that counts, and the range of these.
  void findGas();
  /// Gives values to the points that have none: within the domain those of the gas around, beyond its faces
  /// parabolas through the last three.
  void continueGas();
};

} // namespace schlieren
