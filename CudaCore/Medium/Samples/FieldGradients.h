// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/Vec3.h"
#include "Medium/Samples/Field.h"

#include <cstdint>

namespace schlieren
{

/// What a ray sees of FieldGradients, in index coordinates; in the leaves of a tree, in local coordinates.
struct FieldGradientsView
{
  const float*
    values;  ///< `count` for the point (0, 0, 0), of a tree's first brick, then the next; x fastest
  int count; ///< fields; 0: nothing is to be gathered
  std::int64_t rowStride, planeStride; ///< points
  std::int64_t lastCell[3];
  // Of a tree.
  const std::int32_t* bricks = nullptr; ///< of each leaf; 0: its gradients are 0. Null: an image
  std::int64_t brickStride = 0;         ///< points

  static FieldGradientsView of(const Grid& grid, const FieldGradients& gradients)
  {
    const std::array<std::int64_t, 3>& n = grid.dimensions;
    return { gradients.values, gradients.count, n[0], n[0] * n[1],
      { n[0] - 2, n[1] - 2, n[2] - 2 } };
  }
};

/// Adds `step` times the gradients at a position within the grid or the leaf, interpolated linearly, to `sums`.
template <class Real>
SCHLIEREN_HD void gatherGradients(const FieldGradientsView& view, std::int32_t leaf,
  const Vec3<Real>& position, Real step, float* sums)
{
  const float* first = view.values;
  if (view.bricks != nullptr)
  {
    const std::int32_t brick = view.bricks[leaf];
    if (brick == 0)
    {
      return;
    }
    first += view.count * (brick * view.brickStride);
  }
  const Real x[3] = { position.x, position.y, position.z };
  std::int64_t cell[3];
  float w[3][2];
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t last = view.lastCell[axis];
    const auto towards0 = static_cast<std::int64_t>(x[axis]);
    const std::int64_t i = x[axis] < static_cast<Real>(towards0) ? towards0 - 1 : towards0;
    cell[axis] = i < last ? i : last;
    w[axis][1] = static_cast<float>(x[axis] - static_cast<Real>(cell[axis]));
    w[axis][0] = 1 - w[axis][1];
  }
  for (int corner = 0; corner < 8; ++corner)
  {
    const int i = corner & 1, j = (corner >> 1) & 1, k = corner >> 2;
    const float weight = static_cast<float>(step) * w[0][i] * w[1][j] * w[2][k];
    const float* values = first +
      view.count *
        ((cell[2] + k) * view.planeStride + (cell[1] + j) * view.rowStride + cell[0] + i);
    for (int field = 0; field < view.count; ++field)
    {
      sums[field] += weight * values[field];
    }
  }
}

/// Writes the gradient of one of `count` fields into what will be FieldGradients::values: its length at
/// each point from central differences, or one-sided ones next to the grid's faces and to points where
/// `valid` (may be null) is 0 or the value is not finite; 0 at such points.
void gradientMagnitudes(const Grid& grid, const float* values, const unsigned char* valid,
  int threads, int count, int field, float* gradients);

} // namespace schlieren
