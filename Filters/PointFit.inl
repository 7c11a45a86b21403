// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// FitPoints for packs of `lanes` points. PointFit.cxx includes this once for each set of instructions.

typedef double Real __attribute__((vector_size(sizeof(double) * lanes)));
typedef std::int64_t Mask __attribute__((vector_size(sizeof(double) * lanes)));

SCHLIEREN_INLINE void load(const double* from, Real& pack)
{
  __builtin_memcpy(&pack, from, sizeof(pack));
}

SCHLIEREN_INLINE void store(const Real& pack, double* to)
{
  __builtin_memcpy(to, &pack, sizeof(pack));
}

inline void fitPack(PointFit& fit, int firstPoint)
{
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
  Real spread[3][3], sums[3][3] = {}, low = zero, high = zero;
  const double* const first = fit.numbers.data() + firstPoint;
  const double* const last = first + 4 * points * fit.neighbours;
  for (const double* from = first; from != last; from += 4 * points)
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
  Real perSpread[3];
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k <= i; ++k)
    {
      Real sum = sums[i][k] * perCount;
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

  // The fit's matrix, the lower half of it; its right side, and the sum of the values' squares.
  Real matrix[unknowns][unknowns] = {}, right[unknowns] = {}, all = zero;
  for (const double* from = first; from != last; from += 4 * points)
  {
    Real y[3], value;
    for (int i = 0; i < 3; ++i)
    {
      load(from + i * points, y[i]);
      for (int k = 0; k < i; ++k)
      {
        y[i] -= spread[i][k] * y[k];
      }
      y[i] *= perSpread[i];
    }
    load(from + 3 * points, value);
    const Real weight = 1 / (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + leastSquare);
    const Real terms[unknowns] = { y[0], y[1], y[2], y[0] * y[0], y[1] * y[1], y[2] * y[2],
      y[0] * y[1], y[1] * y[2], y[2] * y[0] };
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
    matrix[i][i] += i < 3 ? leastFirst * trace[0] : leastSecond / 6 * trace[1];
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
    fitPack(of, point);
  }
}
