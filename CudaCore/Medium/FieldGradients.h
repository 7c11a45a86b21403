// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/Vec3.h"
#include "Schlieren.h"

#include <cstdint>

namespace schlieren
{

/// What a ray sees of FieldGradients, in index coordinates.
struct FieldGradientsView
{
  const float* values; ///< `count` for the grid point (0, 0, 0), then the next; x fastest
  int count;           ///< fields; 0: nothing is to be gathered
  std::int64_t dimensions[3];

  static FieldGradientsView of(const Grid& grid, const FieldGradients& gradients)
  {
    return { gradients.values, gradients.count,
      { grid.dimensions[0], grid.dimensions[1], grid.dimensions[2] } };
  }
};

/// Adds `step` times the gradients at a position within the grid, interpolated linearly, to `sums`.
template <class Real>
SCHLIEREN_HD void gatherGradients(
  const FieldGradientsView& view, const Vec3<Real>& position, Real step, float* sums)
{
  const Real x[3] = { position.x, position.y, position.z };
  std::int64_t cell[3];
  float w[3][2];
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t last = view.dimensions[axis] - 2;
    const auto i = static_cast<std::int64_t>(x[axis]);
    cell[axis] = i < last ? i : last;
    w[axis][1] = static_cast<float>(x[axis] - static_cast<Real>(cell[axis]));
    w[axis][0] = 1 - w[axis][1];
  }
  for (int corner = 0; corner < 8; ++corner)
  {
    const int i = corner & 1, j = (corner >> 1) & 1, k = corner >> 2;
    const float weight = static_cast<float>(step) * w[0][i] * w[1][j] * w[2][k];
    const float* values = view.values +
      view.count *
        (((cell[2] + k) * view.dimensions[1] + cell[1] + j) * view.dimensions[0] + cell[0] + i);
    for (int field = 0; field < view.count; ++field)
    {
      sums[field] += weight * values[field];
    }
  }
}

} // namespace schlieren
