// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Samples/Prefilter.h"

#include "Device/Parallel.h"

#include <algorithm>

namespace schlieren
{

namespace
{

/// One axis of a B-spline's equations, with s the samples and c the coefficients. Inside,
/// c_{i-1} + diagonal c_i + c_{i+1} = (diagonal + 2) s_i: a sample is its coefficient and a fraction of the
/// coefficients' second difference, c''. That the coefficients continue as a polynomial makes the rows at an
/// end:
///   degree 2, through the last three: c'' is the same at both last points, so c_0 - c_1 = s_0 - s_1;
///   degree 3, through the last four: c'' is a straight line there, so that c_1'' = s_1'' and with it c_1
///   is known, and c_0 from the row of s_1.
template <class Real>
struct Equations
{
  Equations(int diagonalInside, int degreeOfSpline, std::int64_t points)
    : n(points)
    , degree(std::min<std::int64_t>(degreeOfSpline, points - 1))
    , diagonal(static_cast<Real>(diagonalInside))
    , pivots(static_cast<std::size_t>(n), 0)
  {
    for (std::int64_t i = degree - 2; i >= 0 && i < n; ++i)
    {
      const auto at = static_cast<std::size_t>(i);
      pivots[at] = i >= degree - 1 ? 1 / (diagonal - pivots[at - 1]) : degree == 2 ? -1 : 0;
    }
  }

  std::int64_t n;
  std::int64_t degree; ///< of the ends' polynomial
  Real diagonal;
  std::vector<Real> pivots;
};

/// Thomas's algorithm for one axis, on `width` neighbouring lines at once (their memory is
/// contiguous, so that the inner loops vectorise).
template <class Real>
void solveLines(
  Real* first, std::int64_t stride, std::int64_t width, const Equations<Real>& equations)
{
  const std::int64_t n = equations.n;
  if (n < 3)
  {
    return; // the straight line through two points is its own B-spline
  }
  const std::int64_t inside = equations.degree - 1; // rows from the end to the first one inside
  const Real diagonal = equations.diagonal;
  Real* last = first + (n - 1) * stride;
  if (equations.degree == 2)
  {
    for (std::int64_t x = 0; x < width; ++x)
    {
      first[x] -= first[x + stride];
      last[x] -= last[x - stride];
    }
  }
  else
  {
    const Real fraction = 1 / (diagonal + 2);
    for (std::int64_t x = 0; x < width; ++x)
    {
      const Real low = first[x + stride];
      const Real high = last[x - stride];
      const Real lowBend = fraction * (first[x] - 2 * low + first[x + 2 * stride]);
      const Real highBend = fraction * (last[x] - 2 * high + last[x - 2 * stride]);
      first[x] = 2 * low + diagonal * lowBend; // c_0 + c_2
      last[x] = 2 * high + diagonal * highBend;
      first[x + stride] = low - lowBend;
      last[x - stride] = high - highBend;
    }
  }
  for (std::int64_t i = inside; i < n - inside; ++i)
  {
    Real* row = first + i * stride;
    const Real* previous = row - stride;
    const Real pivot = equations.pivots[static_cast<std::size_t>(i)];
    for (std::int64_t x = 0; x < width; ++x)
    {
      row[x] = pivot * ((diagonal + 2) * row[x] - previous[x]);
    }
  }
  if (equations.degree == 2)
  {
    const Real lastPivot = 1 / (1 + equations.pivots[static_cast<std::size_t>(n - 2)]);
    for (std::int64_t x = 0; x < width; ++x)
    {
      last[x] = lastPivot * (last[x] + last[x - stride]);
    }
  }
  for (std::int64_t i = n - 1 - inside; i >= inside - 1; --i)
  {
    Real* row = first + i * stride;
    const Real* next = row + stride;
    const Real pivot = equations.pivots[static_cast<std::size_t>(i)];
    for (std::int64_t x = 0; x < width; ++x)
    {
      row[x] -= pivot * next[x];
    }
  }
  if (equations.degree == 3)
  {
    for (std::int64_t x = 0; x < width; ++x)
    {
      first[x] -= first[x + 2 * stride];
      last[x] -= last[x - 2 * stride];
    }
  }
}

/// Rows are solved side by side, because each step of a single row waits for the one before.
constexpr std::int64_t rowsAtOnce = 8;

template <class Real>
void transpose(
  const Real* from, std::int64_t stride, std::int64_t rows, std::int64_t columns, Real* to)
{
  for (std::int64_t row = 0; row < rows; ++row)
  {
    for (std::int64_t column = 0; column < columns; ++column)
    {
      to[column * rows + row] = from[row * stride + column];
    }
  }
}

template <class Real>
void transposeBack(
  const Real* from, std::int64_t rows, std::int64_t columns, Real* to, std::int64_t stride)
{
  for (std::int64_t row = 0; row < rows; ++row)
  {
    for (std::int64_t column = 0; column < columns; ++column)
    {
      to[row * stride + column] = from[column * rows + row];
    }
  }
}

template <class Real>
void prefilter(PaddedVolume<Real>& volume, int diagonal, int degree, int threads)
{
  const auto [nx, ny, nz] = volume.dimensions;

  const Equations<Real> alongX(diagonal, degree, nx), alongY(diagonal, degree, ny);
  parallelFor(nz, 1, threads,
    [&, ny = ny, nx = nx](std::int64_t begin, std::int64_t end)
    {
      std::vector<Real> side(static_cast<std::size_t>(nx * rowsAtOnce));
      for (std::int64_t k = begin; k < end; ++k)
      {
        for (std::int64_t j = 0; j < ny; j += rowsAtOnce)
        {
          const std::int64_t rows = std::min(rowsAtOnce, ny - j);
          transpose(&volume.at(0, j, k), volume.strides[1], rows, nx, side.data());
          solveLines(side.data(), rows, rows, alongX);
          transposeBack(side.data(), rows, nx, &volume.at(0, j, k), volume.strides[1]);
        }
        solveLines(&volume.at(0, 0, k), volume.strides[1], nx, alongY);
      }
    });

  const Equations<Real> alongZ(diagonal, degree, nz);
  parallelFor(ny, 1, threads,
    [&, nx = nx](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t j = begin; j < end; ++j)
      {
        solveLines(&volume.at(0, j, 0), volume.strides[2], nx, alongZ);
      }
    });
}

/// Continues the polynomial of `degree` through the last samples, from the end inward, by one.
template <class Real>
Real extrapolate(const Real* end, std::int64_t inward, std::int64_t degree)
{
  switch (degree)
  {
    case 1:
      return 2 * end[0] - end[inward];
    case 2:
      return 3 * (end[0] - end[inward]) + end[2 * inward];
    default: // 3
      return 4 * (end[0] + end[2 * inward]) - 6 * end[inward] - end[3 * inward];
  }
}

} // namespace

template <class Real>
void prefilterQuadratic(PaddedVolume<Real>& volume, int threads)
{
  prefilter(volume, 6, 2, threads);
}

template <class Real>
void prefilterCubic(PaddedVolume<Real>& volume, int threads)
{
  prefilter(volume, 4, 3, threads);
}

template <class Real>
void fillGhosts(PaddedVolume<Real>& volume, int degree)
{
  // Axis by axis; the later axes carry the ghosts of the earlier ones along.
  std::array<std::int64_t, 3> low{ 0, 0, 0 };
  std::array<std::int64_t, 3> high = volume.dimensions;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t n = volume.dimensions[axis];
    const std::int64_t stride = volume.strides[axis];
    const std::int64_t degreeHere = std::min<std::int64_t>(degree, n - 1);
    std::array<std::int64_t, 3> from = low;
    std::array<std::int64_t, 3> to = high;
    from[axis] = 0;
    to[axis] = 1;
    for (std::int64_t k = from[2]; k < to[2]; ++k)
    {
      for (std::int64_t j = from[1]; j < to[1]; ++j)
      {
        for (std::int64_t i = from[0]; i < to[0]; ++i)
        {
          Real* first = &volume.at(i, j, k);
          Real* last = first + (n - 1) * stride;
          first[-stride] = extrapolate(first, stride, degreeHere);
          last[stride] = extrapolate(last, -stride, degreeHere);
        }
      }
    }
    low[axis] = -1;
    high[axis] = n + 1;
  }
}

template void prefilterQuadratic(PaddedVolume<float>&, int);
template void prefilterQuadratic(PaddedVolume<double>&, int);
template void prefilterCubic(PaddedVolume<float>&, int);
template void prefilterCubic(PaddedVolume<double>&, int);
template void fillGhosts(PaddedVolume<float>&, int);
template void fillGhosts(PaddedVolume<double>&, int);

} // namespace schlieren
