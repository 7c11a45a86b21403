// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/Vec3.h"
#include "Medium/Samples/Leaves.h"
#include "Types.h"

#include <cmath>
#include <cstdint>

namespace schlieren
{

/// What a ray sees of the medium: the relative refractivity nu = (N - N_ref) / (1 + N_ref) in leaves, which
/// are bricks of samples that all have the same strides. An image is one leaf, whose local coordinates are
/// the index coordinates (grid point (i, j, k) lies at (i, j, k)). Around each brick there are ghost points,
/// so that no interpolation has to look where it is.
template <class Real>
struct MediumView
{
  /// Sample (quadratic: B-spline coefficient) of the point (-1, -1, -1) of the first brick; x fastest.
  const Real* samples;
  std::int64_t rowStride;   ///< from (i, j, k) to (i, j + 1, k)
  std::int64_t planeStride; ///< from (i, j, k) to (i, j, k + 1)
  Vec3<Real> leafLow;       ///< a leaf's corners, in local coordinates
  Vec3<Real> leafHigh;
  Vec3<double> last; ///< far corner of the domain, in index coordinates; the near one is 0
  /// One bit per point of an image, 1 in solids, laid out like the samples; null where there are no solids.
  const std::uint32_t* solid = nullptr;

  // Of a tree.
  const Leaf<Real>* leaves = nullptr; ///< null: an image
  LeafFinder finder{};
  std::int64_t brickStride = 0; ///< samples from one brick to the next; 0: an image
  /// Laid out like the samples, but with bricks of their own: see MediumTree::gasDistances.
  const std::int16_t* gasDistances = nullptr;
};

/// Local coordinates along z that leaves of one layer reach to, which is beyond any domain; floats still distinguish
/// voxels.
constexpr int depthOfLayers = 1 << 22;

/// Views bricks with `apron` ghost points around each; `samples`: the first of them. Those of one layer have no ghost
/// points along z: its samples are found at all z.
template <class Real>
MediumView<Real> viewOfBricks(const Real* samples, int edge, int apron, BrickShape shape)
{
  const std::int64_t row = edge + 2 * apron;
  const bool isLayer = shape == BrickShape::Layer;
  const std::int64_t plane = isLayer ? 0 : row * row;
  // Views begin at the first of the ghost points that both schemes have.
  const std::int64_t ghost = (apron - 1) * (plane + row + 1);
  constexpr Real low = Real(-0.5);
  const Real high = std::nextafter(Real(edge - 0.5), low); // its nearest sample is the last one
  MediumView<Real> view{ samples + ghost, row, plane, { low, low, low }, { high, high, high }, {} };
  view.leafHigh.z = isLayer ? Real(depthOfLayers) : high;
  view.brickStride = isLayer ? row * row : row * plane;
  return view;
}

/// A value and its derivatives by the index coordinates.
template <class Real>
struct Sample
{
  Real value;
  Vec3<Real> gradient;
};

/// Sums over rows and columns of samples from `corner` on: `w` are the weights of the value, `d` those
/// of the derivative, one row per axis.
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

// The schemes. Each weighs `points` samples along every axis.
//   nearest    whether `f` is counted from the nearest grid point, in [-1/2, 1/2], or from the lower end
//              of the cell, in [0, 1]
//   first      where the first sample lies, from there
//   reach      grid points beyond a cell's corners whose samples have a weight in the cell
//   weights    of the value (w) and of the derivative (d); Real is a number or a pack of numbers

/// Quadratic B-spline (Unser, Aldroubi & Eden 1993): the derivative is continuous, so that no cell
/// boundary shows in a schlieren image.
struct QuadraticInterpolation
{
  static constexpr int points = 3;
  static constexpr bool nearest = true;
  static constexpr int first = -1;
  static constexpr int reach = 1;

  template <class Real>
  SCHLIEREN_HD static void weights(const Real& f, Real (&w)[points], Real (&d)[points])
  {
    using Number = NumberOf<Real>;
    const Number half = static_cast<Number>(0.5);
    d[0] = f - half;
    d[1] = Number(-2) * f;
    d[2] = f + half;
    w[0] = half * d[0] * d[0];
    w[1] = static_cast<Number>(0.75) - f * f;
    w[2] = half * d[2] * d[2];
  }
};

/// Cubic B-spline (Unser, Aldroubi & Eden 1993): the second derivatives are continuous.
struct CubicInterpolation
{
  static constexpr int points = 4;
  static constexpr bool nearest = false;
  static constexpr int first = -1;
  static constexpr int reach = 1;

  template <class Real>
  SCHLIEREN_HD static void weights(const Real& f, Real (&w)[points], Real (&d)[points])
  {
    using Number = NumberOf<Real>;
    const Number half = static_cast<Number>(0.5);
    const Number third = Number(1) / 3;
    const Real g = 1 - f;
    d[0] = -half * g * g;
    d[1] = f * (Number(1.5) * f - 2);
    d[2] = g * (2 - Number(1.5) * g);
    d[3] = half * f * f;
    w[0] = -third * d[0] * g;
    w[1] = 2 * third + f * f * (half * f - 1);
    w[2] = 2 * third + g * g * (half * g - 1);
    w[3] = third * d[3] * f;
  }
};

/// Calls visit with the scheme, an object of its type.
template <class Visit>
auto visitScheme(Interpolation interpolation, const Visit& visit)
{
  return interpolation == Interpolation::Cubic ? visit(CubicInterpolation{})
                                               : visit(QuadraticInterpolation{});
}

/// Value and gradient, by local coordinates, at a position within a leaf whose samples begin at `base`
/// (null: an image's).
template <class Scheme, class Real>
SCHLIEREN_HD auto interpolate(
  const MediumView<Real>& m, const std::int64_t* base, const Vec3<Real>& position) -> Sample<Real>
{
  const Real x[3] = { position.x, position.y, position.z };
  const Real high[3] = { m.leafHigh.x, m.leafHigh.y, m.leafHigh.z };
  const std::int64_t strides[3] = { 1, m.rowStride, m.planeStride };
  const Real* corner = base != nullptr ? m.samples + *base : m.samples;
  Real w[3][Scheme::points], d[3][Scheme::points];
  for (int axis = 0; axis < 3; ++axis)
  {
    int i = static_cast<int>(Scheme::nearest ? x[axis] + static_cast<Real>(0.5) : x[axis]);
    if (!Scheme::nearest && x[axis] < static_cast<Real>(i))
    {
      --i; // bricks begin half a voxel before their first sample
    }
    if (Scheme::points == 4 && m.brickStride == 0 && i >= static_cast<int>(high[axis]))
    {
      i = static_cast<int>(high[axis]) - 1; // the last point ends the last cell
    }
    Scheme::weights(x[axis] - static_cast<Real>(i), w[axis], d[axis]);
    corner += (i + 1 + Scheme::first) * strides[axis]; // 1: the ghost layer
  }
  return tensorProduct<Real, Scheme::points>(m, corner, w, d);
}

/// The same of an image.
template <class Scheme, class Real>
SCHLIEREN_HD auto interpolate(const MediumView<Real>& m, const Vec3<Real>& position) -> Sample<Real>
{
  return interpolate<Scheme>(m, static_cast<const std::int64_t*>(nullptr), position);
}

/// Whether the grid point of an image nearest to a position within [0, last] is solid.
template <class Real>
SCHLIEREN_HD bool isSolid(const MediumView<Real>& m, const Vec3<Real>& position)
{
  const Real half = static_cast<Real>(0.5);
  const std::int64_t at = (static_cast<std::int64_t>(position.z + half) + 1) * m.planeStride +
    (static_cast<std::int64_t>(position.y + half) + 1) * m.rowStride +
    static_cast<std::int64_t>(position.x + half) + 1;
  return ((m.solid[at >> 5] >> (at & 31)) & 1u) != 0;
}

/// How far inside the gas a position within a leaf of kind Mixed is, in voxels; and whether what is outside, next
/// to it, is a window rather than a wall. `map`: where the leaf's gasDistances begin.
struct GasEdge
{
  float distance;
  bool isWindow;
};
template <class Real>
SCHLIEREN_HD GasEdge gasEdge(
  const MediumView<Real>& m, std::int64_t map, const Vec3<Real>& position)
{
  const Real x[3] = { position.x, position.y, position.z };
  const std::int64_t strides[3] = { 1, m.rowStride, m.planeStride };
  std::int64_t corner = map, nearest = 0;
  float f[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    int i = static_cast<int>(x[axis] + 1); // a floor: positions are no less than -1/2
    corner += i * strides[axis];
    --i;
    f[axis] = static_cast<float>(x[axis] - static_cast<Real>(i));
    nearest += f[axis] < 0.5f ? 0 : strides[axis];
  }
  float distance = 0;
  for (int k = 0; k < 8; ++k)
  {
    const std::int64_t at =
      corner + (k & 1) * strides[0] + (k >> 1 & 1) * strides[1] + (k >> 2) * strides[2];
    const float weight = ((k & 1) != 0 ? f[0] : 1 - f[0]) * ((k & 2) != 0 ? f[1] : 1 - f[1]) *
      ((k & 4) != 0 ? f[2] : 1 - f[2]);
    distance += weight * static_cast<float>(m.gasDistances[at] >> 1);
  }
  constexpr float perVoxel = 4096; // the lowest bit has been shifted out
  return { distance / perVoxel, (m.gasDistances[corner + nearest] & 1) != 0 };
}

} // namespace schlieren
