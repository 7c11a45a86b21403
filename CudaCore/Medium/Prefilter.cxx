// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Prefilter.h"

#include "Device/Parallel.h"

#include <algorithm>

namespace schlieren
{

namespace
{

/// Thomas's algorithm for one axis, on `width` neighbouring lines at once (their memory is
/// contiguous, so that the inner loops vectorise). Rows of the system, times 8:
///   c_{i-1} + 6 c_i + c_{i+1} = 8 s_i inside; the parabola through the ends turns the first and the
///   last row into c_0 - c_1 = s_0 - s_1 and c_{n-1} - c_{n-2} = s_{n-1} - s_{n-2}.
template <class Real>
void solveLines(Real* first, std::int64_t n, std::int64_t stride, std::int64_t width,
  const std::vector<Real>& pivots, std::vector<Real>& saved)
{
  if (n < 3)
  {
    return; // the straight line through two points is its own B-spline
  }
  Real* row = first;
  Real* next = row + stride;
  for (std::int64_t x = 0; x < width; ++x)
  {
    row[x] -= next[x];
  }
  for (std::int64_t i = 1; i < n - 1; ++i)
  {
    Real* previous = row;
    row = next;
    next = row + stride;
    const Real pivot = pivots[static_cast<std::size_t>(i)];
    if (i == n - 2)
    {
      std::copy(row, row + width, saved.begin());
    }
    for (std::int64_t x = 0; x < width; ++x)
    {
      row[x] = pivot * (8 * row[x] - previous[x]);
    }
  }
  const Real lastPivot = 1 / (1 + pivots[static_cast<std::size_t>(n - 2)]);
  for (std::int64_t x = 0; x < width; ++x)
  {
    next[x] = lastPivot * (next[x] - saved[static_cast<std::size_t>(x)] + row[x]);
  }
  for (std::int64_t i = n - 2; i >= 0; --i)
  {
    row = first + i * stride;
    next = row + stride;
    const Real pivot = pivots[static_cast<std::size_t>(i)];
    for (std::int64_t x = 0; x < width; ++x)
    {
      row[x] -= pivot * next[x];
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
std::vector<Real> pivotsOf(std::int64_t n)
{
  std::vector<Real> pivots(static_cast<std::size_t>(n));
  pivots[0] = -1;
  for (std::size_t i = 1; i < pivots.size(); ++i)
  {
    pivots[i] = 1 / (6 - pivots[i - 1]);
  }
  return pivots;
}

} // namespace

template <class Real>
void prefilterQuadratic(PaddedVolume<Real>& volume, int threads)
{
  const auto [nx, ny, nz] = volume.dimensions;
  const std::int64_t width = nx;

  const std::vector<Real> xPivots = pivotsOf<Real>(nx);
  const std::vector<Real> yPivots = pivotsOf<Real>(ny);
  parallelFor(nz, 1, threads,
    [&, ny = ny, nx = nx](std::int64_t begin, std::int64_t end)
    {
      std::vector<Real> saved(static_cast<std::size_t>(std::max(width, rowsAtOnce)));
      std::vector<Real> side(static_cast<std::size_t>(nx * rowsAtOnce));
      for (std::int64_t k = begin; k < end; ++k)
      {
        for (std::int64_t j = 0; j < ny; j += rowsAtOnce)
        {
          const std::int64_t rows = std::min(rowsAtOnce, ny - j);
          transpose(&volume.at(0, j, k), volume.strides[1], rows, nx, side.data());
          solveLines(side.data(), nx, rows, rows, xPivots, saved);
          transposeBack(side.data(), rows, nx, &volume.at(0, j, k), volume.strides[1]);
        }
        solveLines(&volume.at(0, 0, k), ny, volume.strides[1], width, yPivots, saved);
      }
    });

  const std::vector<Real> zPivots = pivotsOf<Real>(nz);
  parallelFor(ny, 1, threads,
    [&, nz = nz](std::int64_t begin, std::int64_t end)
    {
      std::vector<Real> saved(static_cast<std::size_t>(width));
      for (std::int64_t j = begin; j < end; ++j)
      {
        solveLines(&volume.at(0, j, 0), nz, volume.strides[2], width, zPivots, saved);
      }
    });
}

template <class Real>
void fillGhosts(PaddedVolume<Real>& volume)
{
  // Axis by axis; the later axes carry the ghosts of the earlier ones along.
  std::array<std::int64_t, 3> low{ 0, 0, 0 };
  std::array<std::int64_t, 3> high = volume.dimensions;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t n = volume.dimensions[axis];
    const std::int64_t stride = volume.strides[axis];
    const auto extrapolate = [n](const Real* end, std::int64_t inward)
    { return n < 3 ? 2 * end[0] - end[inward] : 3 * (end[0] - end[inward]) + end[2 * inward]; };
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
          first[-stride] = extrapolate(first, stride);
          last[stride] = extrapolate(last, -stride);
        }
      }
    }
    low[axis] = -1;
    high[axis] = n + 1;
  }
}

template void prefilterQuadratic(PaddedVolume<float>&, int);
template void prefilterQuadratic(PaddedVolume<double>&, int);
template void fillGhosts(PaddedVolume<float>&);
template void fillGhosts(PaddedVolume<double>&);

} // namespace schlieren
