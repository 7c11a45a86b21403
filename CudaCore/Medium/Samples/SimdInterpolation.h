// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/SimdPack.h"
#include "Medium/Samples/Interpolation.h"

namespace schlieren
{

namespace simd
{

/// Sums over y and z for a fourth of a pack's rays: of the values, of the derivatives by y and by z, each
/// for four neighbours along x. Rows are read whole, whatever number of samples the scheme weighs.
template <class Scheme, int Group, class Real, class Pack>
SCHLIEREN_HD void sumRows(const MediumView<Real>& m, const Real* origin,
  const std::int64_t* offsets, const Pack (&w)[3][Scheme::points],
  const Pack (&d)[3][Scheme::points], Pack& values, Pack& byY, Pack& byZ)
{
  constexpr int points = Scheme::points;
  Pack wy[points], dy[points];
#pragma GCC unroll 4
  for (int j = 0; j < points; ++j)
  {
    wy[j] = spread<Group>(w[1][j]);
    dy[j] = spread<Group>(d[1][j]);
  }
#pragma GCC unroll 4
  for (int k = 0; k < points; ++k)
  {
    Pack value{}, slope{};
#pragma GCC unroll 4
    for (int j = 0; j < points; ++j)
    {
      const Pack row = RowLoader<Real, lanesOf<Pack>>::template load<Group>(
        origin + k * m.planeStride + j * m.rowStride, offsets);
      value = j == 0 ? wy[0] * row : value + wy[j] * row;
      slope = j == 0 ? dy[0] * row : slope + dy[j] * row;
    }
    const Pack wz = spread<Group>(w[2][k]);
    const Pack dz = spread<Group>(d[2][k]);
    values = k == 0 ? wz * value : values + wz * value;
    byY = k == 0 ? wz * slope : byY + wz * slope;
    byZ = k == 0 ? dz * value : byZ + dz * value;
  }
}

template <class Real, class Pack, int Points>
SCHLIEREN_HD Pack weigh(const Pack (&weights)[Points], const Pack (&columns)[4])
{
  Pack sum = weights[0] * columns[0];
#pragma GCC unroll 4
  for (int i = 1; i < Points; ++i)
  {
    sum += weights[i] * columns[i];
  }
  return sum;
}

} // namespace simd

/// Where a pack's rays look: the first of their samples, and the weights of these.
template <class Scheme, class Real, class Pack>
struct Stencil
{
  IntOf<Pack> index[3]; ///< along each axis, from that of the first grid point
  Pack w[3][Scheme::points];
  Pack d[3][Scheme::points];

  /// Bricks begin half a voxel before their first sample: in a cell whose lower end is a ghost point.
  SCHLIEREN_HD static bool countsFromGhosts(const MediumView<Real>& m)
  {
    return !Scheme::nearest && m.brickStride != 0;
  }

  SCHLIEREN_HD Stencil(const MediumView<Real>& m, const Vec3<Pack>& position)
  {
    using Int = IntOf<Pack>;
    const Pack x[3] = { position.x, position.y, position.z };
    const Real high[3] = { m.leafHigh.x, m.leafHigh.y, m.leafHigh.z };
#pragma GCC unroll 3 // or GCC may keep the weights in memory
    for (int axis = 0; axis < 3; ++axis)
    {
      Int i =
        __builtin_convertvector(Scheme::nearest ? x[axis] + static_cast<Real>(0.5) : x[axis], Int);
      if (countsFromGhosts(m))
      {
        i += __builtin_convertvector(x[axis] < __builtin_convertvector(i, Pack), Int);
      }
      else if (Scheme::points == 4)
      {
        const Int lastCell = Int{} + (static_cast<int>(high[axis]) - 1);
        i = i < lastCell ? i : lastCell;
      }
      Scheme::weights(x[axis] - __builtin_convertvector(i, Pack), w[axis], d[axis]);
      index[axis] = countsFromGhosts(m) ? i + 1 : i; // which must not be negative
    }
  }
};

/// tensorProduct for packs. Rows of four samples are loaded and summed over y and z, for a fourth of the rays at a time, and
/// transposed so that the sums over x are done on packs of rays again: as fast as gathers where these are fast, and several
/// times as fast where they are not.
template <class Scheme, class Real, class Pack>
SCHLIEREN_HD Sample<Pack> sumByRows(const MediumView<Real>& m,
  const Stencil<Scheme, Real, Pack>& stencil, const Real* origin, const std::int64_t* base)
{
  constexpr int lanes = lanesOf<Pack>;
  const auto& w = stencil.w;
  const auto& d = stencil.d;
  std::uint32_t x[lanes], y[lanes], z[lanes];
  std::memcpy(x, &stencil.index[0], sizeof(x));
  std::memcpy(y, &stencil.index[1], sizeof(y));
  std::memcpy(z, &stencil.index[2], sizeof(z));
  // Of 32 bits, as products of 64 bits take several instructions.
  const auto row = static_cast<std::uint32_t>(m.rowStride);
  const auto plane = static_cast<std::uint32_t>(m.planeStride);
  std::int64_t offsets[lanes];
#pragma GCC unroll 1 // once it has unrolled the loop, GCC does not vectorise it any more
  for (int ray = 0; ray < lanes; ++ray)
  {
    offsets[ray] = static_cast<std::int64_t>(
      std::uint64_t{ z[ray] } * plane + std::uint64_t{ y[ray] } * row + x[ray]);
  }
  if (base != nullptr)
  {
    for (int ray = 0; ray < lanes; ++ray)
    {
      offsets[ray] += base[ray];
    }
  }

  Pack values[4]{}, byY[4]{}, byZ[4]{};
  simd::sumRows<Scheme, 0>(m, origin, offsets, w, d, values[0], byY[0], byZ[0]);
  simd::sumRows<Scheme, 1>(m, origin, offsets, w, d, values[1], byY[1], byZ[1]);
  simd::sumRows<Scheme, 2>(m, origin, offsets, w, d, values[2], byY[2], byZ[2]);
  simd::sumRows<Scheme, 3>(m, origin, offsets, w, d, values[3], byY[3], byZ[3]);
  Pack valuesAlongX[4], byYAlongX[4], byZAlongX[4];
  simd::transpose(values, valuesAlongX);
  simd::transpose(byY, byYAlongX);
  simd::transpose(byZ, byZAlongX);
  return { simd::weigh<Real>(w[0], valuesAlongX),
    { simd::weigh<Real>(d[0], valuesAlongX), simd::weigh<Real>(w[0], byYAlongX),
      simd::weigh<Real>(w[0], byZAlongX) } };
}

/// Values and gradients at the positions of a pack of rays, each within a leaf; `base`: where the samples of
/// each begin (null: an image's).
template <class Scheme, class Real, class Pack>
SCHLIEREN_HD auto interpolate(const MediumView<Real>& m, const std::int64_t* base,
  const Vec3<Pack>& position) -> std::enable_if_t<(lanesOf<Pack> > 1), Sample<Pack>>
{
  const Stencil<Scheme, Real, Pack> stencil(m, position);
  const int ghosts = Stencil<Scheme, Real, Pack>::countsFromGhosts(m) ? 0 : 1;
  const Real* origin = m.samples + (ghosts + Scheme::first) * (m.planeStride + m.rowStride + 1);
  return sumByRows(m, stencil, origin, base);
}

} // namespace schlieren
