// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/SimdPack.h"
#include "Medium/Interpolation.h"

namespace schlieren
{

namespace simd
{

/// Sums over y and z for a fourth of a pack's rays: of the values, of the derivatives by y and by z, each
/// for four neighbours along x. Rows are read whole, whatever number of samples the scheme weighs.
template <class Scheme, int Group, class Real, class Pack>
SCHLIEREN_HD void sumRows(const MediumView<Real>& m, const Real* const* corners,
  const Pack (&w)[3][Scheme::points], const Pack (&d)[3][Scheme::points], Pack& values, Pack& byY,
  Pack& byZ)
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
        corners, k * m.planeStride + j * m.rowStride);
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
  for (int i = 1; i < Points; ++i)
  {
    sum += weights[i] * columns[i];
  }
  return sum;
}

} // namespace simd

/// Values and gradients at the positions, within [0, last], of a pack of rays.
///
/// Instead of one gather per sample, whose cost is that of a load per ray and sample: rows of four
/// samples are loaded and summed over y and z, four rays' in one register where that is 512 bits wide,
/// and transposed so that the sums over x are done on packs of rays again.
template <class Scheme, class Real, class Pack>
SCHLIEREN_HD auto interpolate(const MediumView<Real>& m, const Vec3<Pack>& position)
  -> std::enable_if_t<(lanesOf<Pack> > 1), Sample<Pack>>
{
  using Int = IntOf<Pack>;
  constexpr int lanes = lanesOf<Pack>;
  const Pack x[3] = { position.x, position.y, position.z };
  const Real last[3] = { m.last.x, m.last.y, m.last.z };
  Pack w[3][Scheme::points], d[3][Scheme::points];
  alignas(64) std::int32_t index[3][lanes];
  for (int axis = 0; axis < 3; ++axis)
  {
    Int i =
      __builtin_convertvector(Scheme::nearest ? x[axis] + static_cast<Real>(0.5) : x[axis], Int);
    if (Scheme::points == 4)
    {
      const Int lastCell = Int{} + (static_cast<int>(last[axis]) - 1);
      i = i < lastCell ? i : lastCell;
    }
    Scheme::weights(x[axis] - __builtin_convertvector(i, Pack), w[axis], d[axis]);
    std::memcpy(index[axis], &i, sizeof(i));
  }
  const Real* corners[lanes];
  const Real* origin = m.samples + (1 + Scheme::first) * (m.planeStride + m.rowStride + 1);
  for (int ray = 0; ray < lanes; ++ray)
  {
    corners[ray] =
      origin + index[2][ray] * m.planeStride + index[1][ray] * m.rowStride + index[0][ray];
  }

  Pack values[4]{}, byY[4]{}, byZ[4]{};
  simd::sumRows<Scheme, 0>(m, corners, w, d, values[0], byY[0], byZ[0]);
  simd::sumRows<Scheme, 1>(m, corners, w, d, values[1], byY[1], byZ[1]);
  simd::sumRows<Scheme, 2>(m, corners, w, d, values[2], byY[2], byZ[2]);
  simd::sumRows<Scheme, 3>(m, corners, w, d, values[3], byY[3], byZ[3]);
  Pack valuesAlongX[4], byYAlongX[4], byZAlongX[4];
  simd::transpose(values, valuesAlongX);
  simd::transpose(byY, byYAlongX);
  simd::transpose(byZ, byZAlongX);
  return { simd::weigh<Real>(w[0], valuesAlongX),
    { simd::weigh<Real>(d[0], valuesAlongX), simd::weigh<Real>(w[0], byYAlongX),
      simd::weigh<Real>(w[0], byZAlongX) } };
}

} // namespace schlieren
