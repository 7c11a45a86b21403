// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Decides how fine a node of the medium's tree needs to be: of N, and of the fields whose gradients rays gather.
#pragma once

#include "Medium/Samples/Leaves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace schlieren
{

/// Converts a range of nu within a node to the deflection that it may make there. A variation over the whole node makes
/// one as large as itself, one over a sixteenth of it, along the ray, 16 times as much.
inline constexpr double deflectionByRange = 8;

/// Boxes whose voxels are no larger than this fraction of a cell are not divided, so that voxels have 0.7 ... 1.4 cells
/// in the end. Of data that are linear in cells, finer voxels show the facets (a ball of width 0.2 and cells of 0.025,
/// rays along both: rms error 1.3e-2 with half a cell, 3.4e-3 with one, 5.9e-3 with 1.4; oblique 3e-3 with all).
inline constexpr double voxelByCell = 1.4;

/// The same where gas ends: with finer voxels, edges show nothing new.
inline constexpr double edgeVoxelByCell = 0.5;

/// Voxels this much coarser than cells may miss what cells have.
inline constexpr double coarseByCell = 2;

/// What the cells have beyond the range of the samples is taken for something that was missed where it is more
/// than this fraction of that range: peaks, too, lie between samples.
inline constexpr double missedByRange = 0.5;

/// The larger of `most` and a row's third differences, place by place; `s` leads to the next sample.
inline void widenByThirdDifferences(const double* p, std::ptrdiff_t s, int count, double* most)
{
  for (int i = 0; i < count; ++i)
  {
    const double third = std::abs(p[i + 3 * s] - p[i] - 3 * (p[i + 2 * s] - p[i + s]));
    most[i] = most[i] < third ? third : most[i];
  }
}

/// The same of those between places that all count.
inline void widenByThirdDifferences(
  const double* p, const unsigned char* counts, std::ptrdiff_t s, int count, double* most)
{
  for (int i = 0; i < count; ++i)
  {
    if ((counts[i] & counts[i + s] & counts[i + 2 * s] & counts[i + 3 * s]) != 0)
    {
      widenByThirdDifferences(p + i, s, 1, most + i);
    }
  }
}

/// A cube of `points` along each edge within a larger one of `n`, `first` from its sides; or a square of one layer.
struct InnerCube
{
  int n, first, points;
  BrickShape shape;
};

/// The largest third difference of `values` along an axis. Of differences with places where `counts` is 0, none; empty:
/// all count.
inline double largestThirdDifference(const double* values, const std::vector<unsigned char>& counts,
  const InnerCube& cube, std::size_t axis)
{
  constexpr std::size_t maxPoints = 64;
  std::array<double, maxPoints> most{};
  const bool isLayer = cube.shape == BrickShape::Layer;
  const int firstLayer = isLayer ? 0 : cube.first;
  std::array<int, 3> to{ cube.points, cube.points, isLayer ? 1 : cube.points };
  to[axis] -= 3;
  const std::array<std::ptrdiff_t, 3> strides{ 1, cube.n, std::ptrdiff_t{ cube.n } * cube.n };
  for (int k = 0; k < to[2]; ++k)
  {
    for (int j = 0; j < to[1]; ++j)
    {
      const std::ptrdiff_t row =
        cube.first + (cube.first + j) * strides[1] + (firstLayer + k) * strides[2];
      if (counts.empty())
      {
        widenByThirdDifferences(values + row, strides[axis], to[0], most.data());
      }
      else
      {
        widenByThirdDifferences(
          values + row, counts.data() + row, strides[axis], to[0], most.data());
      }
    }
  }
  return *std::max_element(most.begin(), most.end());
}

} // namespace schlieren
