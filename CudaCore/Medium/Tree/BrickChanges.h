// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the samples of a node's child change about those of the node: so much was wrong with them, whatever the reason
// (cells that are finer than voxels, walls, sheets between two values).
#pragma once

#include "Medium/Tree/Brick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// An error that falls with the square of the voxels is a third of what halving them has changed.
inline constexpr double errorByChange = 1. / 3;

/// Third differences of samples know little of what cells have between them (of a blunt fin's mesh they were a fifth
/// of the error). This is to suffice where there is nothing coarser to compare with.
inline constexpr double errorByCells = 2;

/**
 * The coefficients of a node (samples with an apron of one) become those of one of its children, which has voxels of half
 * the size. Of quadratic splines exactly: each has 3/4 of the nearest one and 1/4 of the next (Chaikin 1974); of linear
 * interpolation at the samples. `child`: its number, x fastest.
 */
template <class Real>
std::vector<Real> coefficientsOfChild(const Real* of, std::int32_t child, BrickShape shape)
{
  constexpr int n = BrickMaker<Real>::edge + 2;
  const int layers = shape == BrickShape::Layer ? 1 : n;
  std::array<int, 3> size{ n, n, layers };
  std::vector<Real> values(of, of + std::ptrdiff_t{ n } * n * layers);
  std::vector<Real> next(values.size());
  const std::array<int, 3> strides{ 1, n, n * n };
  for (std::size_t axis = 0; axis < (layers == 1 ? 2u : 3u); ++axis)
  {
    const int first = (child >> axis & 1) * BrickMaker<Real>::edge;
    const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (int i = 0; i < n; ++i)
    {
      const int at = first + i - 1;     // in the node, counted in voxels of the child
      const int nearest = (at + 2) / 2; // counted from the apron on
      const int other = nearest + (at % 2 != 0 ? 1 : -1); // an odd one is nearer to the next
      for (int p = 0; p < size[a]; ++p)
      {
        for (int q = 0; q < size[b]; ++q)
        {
          const int line = p * strides[a] + q * strides[b];
          next[static_cast<std::size_t>(line + i * strides[axis])] =
            Real(0.75) * values[static_cast<std::size_t>(line + nearest * strides[axis])] +
            Real(0.25) * values[static_cast<std::size_t>(line + other * strides[axis])];
        }
      }
    }
    std::swap(values, next);
  }
  return values;
}

/**
 * How much the deflection of a ray over a child of a node has changed, by axis, when the child got samples of its own, at
 * most. Where there are walls, by the gradients that gas contributes to.
 * `parent`: the coefficients of the node, relative to `offset`.
 */
template <class Real>
std::array<double, 3> changesOf(const Brick<Real>& made, std::int32_t child, const Real* parent,
  Real offset, BrickShape shape, const std::array<double, 3>& voxel)
{
  constexpr int n = BrickMaker<Real>::edge + 2;
  std::array<double, 3> changes{ 0, 0, 0 };
  if (made.samples.empty())
  {
    return changes;
  }
  std::vector<Real> difference = coefficientsOfChild(parent, child, shape);
  const Real shift = offset - made.offset;
  for (std::size_t i = 0; i < difference.size(); ++i)
  {
    difference[i] = made.samples[i] - (difference[i] + shift);
  }
  const std::array<int, 3> strides{ 1, n, n * n };
  const std::size_t axes = shape == BrickShape::Layer ? 2 : 3;
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    const auto stride = static_cast<std::size_t>(strides[axis]);
    std::array<int, 3> to{ n, n, axes == 2 ? 1 : n };
    to[axis] -= 1;
    Real largest = 0;
    for (int k = 0; k < to[2]; ++k)
    {
      for (int j = 0; j < to[1]; ++j)
      {
        for (int i = 0; i < to[0]; ++i)
        {
          const auto at = static_cast<std::size_t>(i + j * strides[1] + k * strides[2]);
          const bool isGas = made.gasDistances.empty() || made.gasDistances[at] > 0 ||
            made.gasDistances[at + stride] > 0;
          const Real change = std::abs(difference[at + stride] - difference[at]);
          largest = isGas && change > largest ? change : largest;
        }
      }
    }
    double longest = 0;
    for (std::size_t other = 0; other < axes; ++other)
    {
      longest = other == axis ? longest : std::max(longest, voxel[other]);
    }
    changes[axis] = static_cast<double>(largest) * BrickMaker<Real>::edge * longest / voxel[axis];
  }
  return changes;
}

} // namespace schlieren
