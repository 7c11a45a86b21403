// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/Vec3.h"

#include <cstdint>

namespace schlieren
{

/// What a ray sees of the medium: the relative refractivity nu = (N - N_ref) / (1 + N_ref) on the
/// grid, in index coordinates (grid point (i, j, k) lies at (i, j, k)), with one layer of ghost
/// points around it, so that no interpolation has to look where it is.
template <class Real>
struct MediumView
{
  /// Sample (quadratic: B-spline coefficient) of the ghost point (-1, -1, -1); x fastest.
  const Real* samples;
  std::int64_t rowStride;   ///< from (i, j, k) to (i, j + 1, k)
  std::int64_t planeStride; ///< from (i, j, k) to (i, j, k + 1)
  Vec3<Real> last;          ///< dimensions - 1: the largest index coordinates
  /// One bit per point, 1 in solids, laid out like the samples; null where there are no solids.
  const std::uint32_t* solid;
};

/// A value and its derivatives by the index coordinates.
template <class Real>
struct Sample
{
  Real value;
  Vec3<Real> gradient;
};

/// Three-point products along x, then y, then z; `w` are the weights of the value, `d` those of the
/// derivative, one row per axis.
template <class Real, int Points>
SCHLIEREN_HD Sample<Real> tensorProduct(const MediumView<Real>& m, const Real* corner,
  const Real (&w)[3][Points], const Real (&d)[3][Points])
{
  Sample<Real> sum{ 0, { 0, 0, 0 } };
  for (int k = 0; k < Points; ++k)
  {
    Real value = 0, byX = 0, byY = 0;
    for (int j = 0; j < Points; ++j)
    {
      const Real* row = corner + k * m.planeStride + j * m.rowStride;
      Real rowValue = 0, rowByX = 0;
      for (int i = 0; i < Points; ++i)
      {
        rowValue += w[0][i] * row[i];
        rowByX += d[0][i] * row[i];
      }
      value += w[1][j] * rowValue;
      byX += w[1][j] * rowByX;
      byY += d[1][j] * rowValue;
    }
    sum.value += w[2][k] * value;
    sum.gradient += Vec3<Real>{ w[2][k] * byX, w[2][k] * byY, d[2][k] * value };
  }
  return sum;
}

/// Quadratic B-spline (Unser, Aldroubi & Eden 1993): the derivative is continuous, so that no cell
/// boundary shows in a schlieren picture. Position within [0, last].
struct QuadraticInterpolation
{
  /// Grid points beyond a cell's corners whose samples have a weight in the cell.
  static constexpr int reach = 1;

  template <class Real>
  SCHLIEREN_HD static Sample<Real> at(const MediumView<Real>& m, const Vec3<Real>& position)
  {
    const Real half = static_cast<Real>(0.5);
    const Real x[3] = { position.x, position.y, position.z };
    std::int64_t nearest[3];
    Real w[3][3], d[3][3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const int i = static_cast<int>(x[axis] + half);
      const Real f = x[axis] - static_cast<Real>(i);
      nearest[axis] = i;
      w[axis][0] = half * (half - f) * (half - f);
      w[axis][1] = static_cast<Real>(0.75) - f * f;
      w[axis][2] = half * (half + f) * (half + f);
      d[axis][0] = f - half;
      d[axis][1] = -2 * f;
      d[axis][2] = f + half;
    }
    // The ghost layer shifts the stored indices by one, which is the left neighbour's shift.
    return tensorProduct<Real, 3>(
      m, m.samples + nearest[2] * m.planeStride + nearest[1] * m.rowStride + nearest[0], w, d);
  }
};

/// Trilinear: the derivative jumps from cell to cell. Position within [0, last].
struct LinearInterpolation
{
  static constexpr int reach = 0;

  template <class Real>
  SCHLIEREN_HD static Sample<Real> at(const MediumView<Real>& m, const Vec3<Real>& position)
  {
    const Real x[3] = { position.x, position.y, position.z };
    std::int64_t cell[3];
    Real w[3][2], d[3][2];
    for (int axis = 0; axis < 3; ++axis)
    {
      const int i = static_cast<int>(x[axis]);
      const Real f = x[axis] - static_cast<Real>(i);
      cell[axis] = i + 1; // past the ghost layer; the cell past `last` ends in ghosts with weight 0
      w[axis][0] = 1 - f;
      w[axis][1] = f;
      d[axis][0] = -1;
      d[axis][1] = 1;
    }
    return tensorProduct<Real, 2>(
      m, m.samples + cell[2] * m.planeStride + cell[1] * m.rowStride + cell[0], w, d);
  }
};

/// Whether the grid point nearest to a position within [0, last] is solid.
template <class Real>
SCHLIEREN_HD bool isSolid(const MediumView<Real>& m, const Vec3<Real>& position)
{
  const Real half = static_cast<Real>(0.5);
  const std::int64_t at = (static_cast<std::int64_t>(position.z + half) + 1) * m.planeStride +
    (static_cast<std::int64_t>(position.y + half) + 1) * m.rowStride +
    static_cast<std::int64_t>(position.x + half) + 1;
  return ((m.solid[at >> 5] >> (at & 31)) & 1u) != 0;
}

} // namespace schlieren
