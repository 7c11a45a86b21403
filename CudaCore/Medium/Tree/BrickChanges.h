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

/// One beside an edge, beyond which values continue as lines, falls with the voxels.
inline constexpr double errorByChangeAtEdges = 1;

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
 * What the gradients of a child of a node along an axis have changed by, times a factor, when the child got samples of its
 * own; nu by voxel. `difference`: of the coefficients.
 */
template <class Real>
std::vector<float> gradientChanges(const Brick<Real>& made, const std::vector<Real>& difference,
  BrickShape shape, std::size_t axis, GradientsOf which, double factor)
{
  constexpr int edge = BrickMaker<Real>::edge, n = edge + 2;
  const std::array<std::ptrdiff_t, 3> strides{ 1, n, n * n };
  const std::ptrdiff_t s = strides[axis];
  const bool isLayer = shape == BrickShape::Layer;
  const int layers = isLayer ? 1 : edge;
  std::vector<float> changes(static_cast<std::size_t>(edge * edge * layers));
  float* to = changes.data();
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < edge; ++j, to += edge)
    {
      const std::ptrdiff_t row = 1 + (j + 1) * strides[1] + (isLayer ? 0 : k + 1) * strides[2];
      const Real* from = difference.data() + row;
      for (int i = 0; i < edge; ++i)
      {
        to[i] = static_cast<float>(factor * static_cast<double>(from[i + s] - from[i]));
      }
      if (made.gasDistances.empty())
      {
        continue;
      }
      const std::int16_t* gas = made.gasDistances.data() + row;
      for (int i = 0; i < edge; ++i)
      {
        const bool isLast = std::array{ i, j, k }[axis] + 1 == edge;
        const bool isGas = gas[i] > 0 && gas[i + s] > 0;
        const bool isAround = gas[i - s] > 0 && gas[i + (isLast ? 1 : 2) * s] > 0;
        to[i] = isGas && isAround == (which == GradientsOf::Gas) ? to[i] : 0.f;
      }
    }
  }
  return changes;
}

/**
 * Adds the errors that are left in a child of a node by what its own samples have changed, along axes that can improve.
 * `parent`: the coefficients of the node, relative to `offset`; `voxel`: of the child.
 */
template <class Real>
void addErrorsByChange(Brick<Real>& made, std::int32_t child, const Real* parent, Real offset,
  BrickShape shape, const std::array<double, 3>& voxel)
{
  if (made.samples.empty())
  {
    return;
  }
  std::vector<Real> difference = coefficientsOfChild(parent, child, shape);
  const Real shift = offset - made.offset;
  for (std::size_t i = 0; i < difference.size(); ++i)
  {
    difference[i] = made.samples[i] - (difference[i] + shift);
  }
  BrickFacts& facts = made.facts;
  for (std::size_t axis = 0; axis < (shape == BrickShape::Layer ? 2u : 3u); ++axis)
  {
    const auto add = [&](GradientsOf which, double factor)
    {
      addLines(gradientChanges(made, difference, shape, axis, which, factor), axis, shape, voxel,
        which, facts.errors);
    };
    if (facts.canImprove[axis])
    {
      add(GradientsOf::Gas, errorByChange);
    }
    if (facts.canImproveAtEdges[axis] && !made.gasDistances.empty())
    {
      add(GradientsOf::Edges, errorByChangeAtEdges);
    }
  }
}

} // namespace schlieren
