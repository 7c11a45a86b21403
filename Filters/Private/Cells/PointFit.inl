// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// FitPoints for packs of `lanes` points. PointFit.cxx includes this once for each set of instructions.

/// Units for moments: those of a lower triangular matrix, and what a symmetric one makes of them.
struct Units
{
  Real spread[3][3], perSpread[3], shrunk[3][3];

  SCHLIEREN_INLINE void scale(const Real* x, Real* y) const
  {
    for (int i = 0; i < 3; ++i)
    {
      y[i] = x[i];
      for (int k = 0; k < i; ++k)
      {
        y[i] -= this->spread[i][k] * y[k];
      }
      y[i] *= this->perSpread[i];
    }
  }

  SCHLIEREN_INLINE void shrink(Real* y) const
  {
    const Real x[3] = { y[0], y[1], y[2] };
    for (int i = 0; i < 3; ++i)
    {
      y[i] = this->shrunk[i][0] * x[0] + this->shrunk[i][1] * x[1] + this->shrunk[i][2] * x[2];
    }
  }

  /// Of second moments xx, yy, zz, xy, yz, zx: the same along rows and columns.
  template <bool shrinks>
  SCHLIEREN_INLINE void scaleSecond(const Real* from, Real* to) const
  {
    const Real rows[3][3] = { { from[0], from[3], from[5] }, { from[3], from[1], from[4] },
      { from[5], from[4], from[2] } };
    Real half[3][3];
    for (int i = 0; i < 3; ++i)
    {
      this->scale(rows[i], half[i]);
      if constexpr (shrinks)
      {
        this->shrink(half[i]);
      }
    }
    Real all[3][3];
    for (int k = 0; k < 3; ++k)
    {
      const Real column[3] = { half[0][k], half[1][k], half[2][k] };
      this->scale(column, all[k]);
      if constexpr (shrinks)
      {
        this->shrink(all[k]);
      }
    }
    to[0] = all[0][0];
    to[1] = all[1][1];
    to[2] = all[2][2];
    to[3] = all[0][1];
    to[4] = all[1][2];
    to[5] = all[2][0];
  }

  /// Along directions in which `places` (second moments in the units so far) lie as close together as nothing else is to
  /// be compared with, as those of one layer of cells do, units become so large that nothing is found there.
  SCHLIEREN_INLINE void shrinkWhereFlat(const Real* places)
  {
    Real m[3][3] = { { places[0] + flat, places[3], places[5] },
      { places[3], places[1] + flat, places[4] }, { places[5], places[4], places[2] + flat } };
    Real minors[3][3];
    for (int i = 0; i < 3; ++i)
    {
      const int a = (i + 1) % 3, b = (i + 2) % 3;
      for (int k = 0; k < 3; ++k)
      {
        const int c = (k + 1) % 3, d = (k + 2) % 3;
        minors[i][k] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
      }
    }
    const Real perVolume =
      flat / (m[0][0] * minors[0][0] + m[0][1] * minors[0][1] + m[0][2] * minors[0][2]);
    for (int i = 0; i < 3; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        this->shrunk[i][k] = (i == k ? 1 : 0) - perVolume * minors[i][k];
      }
    }
  }
};

template <bool ofMeans>
inline void fitPack(PointFit& fit, int firstPoint)
{
  constexpr std::ptrdiff_t perNeighbour = ofMeans ? 10 : 4;
  constexpr int points = PointFit::points;
  const Real zero = {};
  Real perCount = zero;
  Mask isGood = zero == zero;
  for (int lane = 0; lane < lanes; ++lane)
  {
    const std::size_t count = fit.counts[firstPoint + lane];
    perCount[lane] = 1 / static_cast<double>(count > 0 ? count : 1);
    isGood[lane] = count >= fewest ? -1 : 0;
  }

  // L with L * transposed(L) = the mean of x * transposed(x): places in units of it are as far along every axis.
  Units units;
  Real(&spread)[3][3] = units.spread;
  Real sums[3][3] = {}, low = zero, high = zero;
  const double* const first = fit.numbers.data() + firstPoint;
  const double* const last =
    first + perNeighbour * points * static_cast<std::ptrdiff_t>(fit.neighbours);
  for (const double* from = first; from != last; from += perNeighbour * points)
  {
    Real x[3], value;
    for (int i = 0; i < 3; ++i)
    {
      load(from + i * points, x[i]);
    }
    load(from + 3 * points, value);
    low = value < low ? value : low;
    high = value > high ? value : high;
    for (int i = 0; i < 3; ++i)
    {
      for (int k = 0; k <= i; ++k)
      {
        sums[i][k] += x[i] * x[k];
      }
    }
  }
  store(low, fit.lowest + firstPoint);
  store(high, fit.highest + firstPoint);
  const Real least = leastFirst * (sums[0][0] + sums[1][1] + sums[2][2]);
  Real own[unknowns];
  for (int i = 0; i < unknowns && ofMeans; ++i)
  {
    load(fit.own[i] + firstPoint, own[i]);
  }
  Real(&perSpread)[3] = units.perSpread;
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k <= i; ++k)
    {
      Real sum = sums[i][k] * perCount;
      if constexpr (ofMeans)
      {
        // With the size of what the mean is over: where all have the same place along an axis, that is its unit.
        sum += own[i == k ? 3 + i : i == 1 ? 6 : k == 1 ? 7 : 8] - own[i] * own[k];
      }
      for (int j = 0; j < k; ++j)
      {
        sum -= spread[i][j] * spread[k][j];
      }
      if (k < i)
      {
        spread[i][k] = sum * perSpread[k];
        continue;
      }
      sum += least;
      isGood &= sum > 0;
      for (int lane = 0; lane < lanes; ++lane)
      {
        spread[i][i][lane] = std::sqrt(sum[lane] > 0 ? sum[lane] : 1);
      }
      perSpread[i] = 1 / spread[i][i];
    }
  }

  if constexpr (ofMeans)
  {
    const Real places[6] = { sums[0][0] * perCount, sums[1][1] * perCount, sums[2][2] * perCount,
      sums[1][0] * perCount, sums[2][1] * perCount, sums[2][0] * perCount };
    Real scaled[6];
    units.scaleSecond<false>(places, scaled);
    units.shrinkWhereFlat(scaled);
  }

  // The fit's matrix, the lower half of it; its right side, and the sum of the values' squares.
  Real matrix[unknowns][unknowns] = {}, right[unknowns] = {}, all = zero;
  for (const double* from = first; from != last; from += perNeighbour * points)
  {
    Real x[3], y[3], value;
    for (int i = 0; i < 3; ++i)
    {
      load(from + i * points, x[i]);
    }
    units.scale(x, y);
    if constexpr (ofMeans)
    {
      units.shrink(y);
    }
    load(from + 3 * points, value);
    const Real weight = 1 / (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + leastSquare);
    Real terms[unknowns] = { y[0], y[1], y[2], y[0] * y[0], y[1] * y[1], y[2] * y[2], y[0] * y[1],
      y[1] * y[2], y[2] * y[0] };
    if constexpr (ofMeans)
    {
      Real second[6];
      for (int i = 0; i < 6; ++i)
      {
        load(from + (4 + i) * points, second[i]);
      }
      units.scaleSecond<true>(second, terms + 3);
    }
    for (int i = 0; i < unknowns; ++i)
    {
      const Real weighted = weight * terms[i];
      for (int k = 0; k <= i; ++k)
      {
        matrix[i][k] += weighted * terms[k];
      }
      right[i] += weighted * value;
    }
    all += weight * value * value;
  }
  Real trace[2] = { zero, zero };
  for (int i = 0; i < unknowns; ++i)
  {
    trace[i / 3 > 0] += matrix[i][i];
  }
  for (int i = 0; i < unknowns; ++i)
  {
    matrix[i][i] += i < 3 ? (ofMeans ? leastFirstOfMeans : leastFirst) * trace[0]
                          : (ofMeans ? leastSecondOfMeans : leastSecond) / 6 * trace[1];
  }

  // matrix = U * D * transposed(U), by columns; U has 1 in its diagonal, where 1 / D is put.
  for (int k = 0; k < unknowns; ++k)
  {
    isGood &= matrix[k][k] > 0;
    const Real perDiagonal = 1 / (matrix[k][k] > 0 ? matrix[k][k] : zero + 1);
    Real column[unknowns];
    for (int i = k + 1; i < unknowns; ++i)
    {
      column[i] = matrix[i][k];
      matrix[i][k] *= perDiagonal;
    }
    for (int i = k + 1; i < unknowns; ++i)
    {
      for (int j = k + 1; j <= i; ++j)
      {
        matrix[i][j] -= matrix[i][k] * column[j];
      }
    }
    matrix[k][k] = perDiagonal;
  }
  Real x[unknowns];
  for (int i = 0; i < unknowns; ++i)
  {
    x[i] = right[i];
    for (int j = 0; j < i; ++j)
    {
      x[i] -= matrix[i][j] * x[j];
    }
  }
  // What is left of the squares: for the best fit, all that the right side does not take away.
  Real left = all;
  for (int i = unknowns - 1; i >= 0; --i)
  {
    x[i] *= matrix[i][i];
    for (int j = i + 1; j < unknowns; ++j)
    {
      x[i] -= matrix[j][i] * x[j];
    }
    left -= x[i] * right[i];
  }
  if constexpr (ofMeans)
  {
    Real scaled[unknowns];
    units.scale(own, scaled);
    units.shrink(scaled);
    units.scaleSecond<true>(own + 3, scaled + 3);
    Real correction = zero;
    for (int i = 0; i < unknowns; ++i)
    {
      correction -= x[i] * scaled[i];
    }
    isGood &= correction * 0 == 0;
    correction = isGood ? correction : zero;
    store(correction, fit.correction + firstPoint);
    units.shrink(x);
  }
  Real gradient[3];
  for (int i = 2; i >= 0; --i)
  {
    gradient[i] = x[i];
    for (int k = i + 1; k < 3; ++k)
    {
      gradient[i] -= spread[k][i] * gradient[k];
    }
    gradient[i] *= perSpread[i];
  }
  isGood &= (gradient[0] + gradient[1] + gradient[2]) * 0 == 0;
  for (int i = 0; i < 3; ++i)
  {
    gradient[i] = isGood ? gradient[i] : zero;
    store(gradient[i], fit.gradient[i] + firstPoint);
  }
  const Real unfit = left / (all > 0 ? all : zero + 1);
  store(unfit, fit.unfit + firstPoint);
}

inline void fit(PointFit& of)
{
  for (int point = 0; point < PointFit::points; point += lanes)
  {
    if (of.values == PointFit::Values::Means)
    {
      fitPack<true>(of, point);
    }
    else
    {
      fitPack<false>(of, point);
    }
  }
}
