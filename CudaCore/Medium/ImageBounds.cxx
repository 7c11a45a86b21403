// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/ImageBounds.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace schlieren
{

namespace
{

/// The larger of `most` and |b - a|, place by place, so that it vectorises.
template <class Real>
void widenByDifferences(const Real* a, const Real* b, std::int64_t count, Real* most)
{
  for (std::int64_t i = 0; i < count; ++i)
  {
    const Real difference = std::abs(b[i] - a[i]);
    most[i] = most[i] < difference ? difference : most[i];
  }
}

/// Cells along the edges of the boxes of Medium::steepest.
constexpr std::int64_t slopeEdge = 8;

/// Largest differences of neighbours along each axis.
template <class Real>
struct Steepest
{
  Real x, y, z;
};

/// The samples that any scheme looks at in the cells of block n along an axis, ghosts included: [first, last].
struct SamplesOfBlock
{
  std::int64_t first, last;
  SamplesOfBlock(std::int64_t n, std::int64_t points)
    : first(n * slopeEdge - 1)
    , last(std::min((n + 1) * slopeEdge + 1, points))
  {
  }
};

/// Finds the slopes in the blocks of a plane of samples, row by row. z: to the plane above, where there is one.
template <class Real>
void findSlopesOfPlane(
  const PaddedVolume<Real>& volume, std::int64_t k, std::int64_t columns, Steepest<Real>* blocks)
{
  const auto [nx, ny, nz] = volume.dimensions;
  const std::int64_t width = nx + 2;
  const std::int64_t toZ = k < nz ? volume.strides[2] : 0;
  const std::int64_t rows = (ny - 2) / slopeEdge + 1;
  std::vector<Real> x(static_cast<std::size_t>(width)), y(x), z(x);
  for (std::int64_t row = 0; row < rows; ++row)
  {
    for (std::vector<Real>* most : { &x, &y, &z })
    {
      std::fill(most->begin(), most->end(), Real(0));
    }
    const SamplesOfBlock ofRow(row, ny);
    for (std::int64_t j = ofRow.first; j <= ofRow.last; ++j)
    {
      const Real* samples = volume.samples.data() + volume.index(-1, j, k);
      widenByDifferences(samples, samples + 1, width - 1, x.data());
      widenByDifferences(
        samples, samples + (j < ofRow.last ? volume.strides[1] : 0), width, y.data());
      widenByDifferences(samples, samples + toZ, width, z.data());
    }
    for (std::int64_t column = 0; column < columns; ++column)
    {
      const SamplesOfBlock ofColumn(column, nx);
      const auto first = ofColumn.first + 1, last = ofColumn.last + 1; // in arrays
      *blocks++ = { *std::max_element(x.begin() + first, x.begin() + last),
        *std::max_element(y.begin() + first, y.begin() + last + 1),
        *std::max_element(z.begin() + first, z.begin() + last + 1) };
    }
  }
}

} // namespace

template <class Real>
void findBounds(Medium<Real>& medium, int threads)
{
  const PaddedVolume<Real>& volume = medium.volume;
  const auto [nx, ny, nz] = volume.dimensions;
  const std::int64_t columns = (nx - 2) / slopeEdge + 1;
  const std::int64_t rows = (ny - 2) / slopeEdge + 1;
  const std::int64_t layers = (nz - 2) / slopeEdge + 1;
  const std::int64_t ofPlane = columns * rows;
  std::vector<Steepest<Real>> planes(static_cast<std::size_t>(ofPlane * (nz + 2)));
  std::vector<Real> largestNu(static_cast<std::size_t>(nz + 2));
  parallelFor(nz + 2, 1, threads,
    [&, nx = nx, ny = ny](std::int64_t begin, std::int64_t end)
    {
      const std::vector<Real> zeros(static_cast<std::size_t>(nx + 2), 0);
      for (std::int64_t plane = begin; plane < end; ++plane)
      {
        std::vector<Real> nu(zeros);
        for (std::int64_t j = -1; j <= ny; ++j)
        {
          widenByDifferences(volume.samples.data() + volume.index(-1, j, plane - 1), zeros.data(),
            nx + 2, nu.data());
        }
        largestNu[static_cast<std::size_t>(plane)] = *std::max_element(nu.begin(), nu.end());
        findSlopesOfPlane(volume, plane - 1, columns, planes.data() + plane * ofPlane);
      }
    });
  medium.largestNu = static_cast<double>(*std::max_element(largestNu.begin(), largestNu.end()));
  for (std::int64_t n = 0; n < ofPlane * layers; ++n)
  {
    const std::int64_t at[3] = { n % columns, n / columns % rows, n / ofPlane };
    const SamplesOfBlock ofLayer(at[2], nz);
    Steepest<Real> most{ 0, 0, 0 };
    for (std::int64_t k = ofLayer.first; k <= ofLayer.last; ++k)
    {
      const Steepest<Real>& one = planes[static_cast<std::size_t>((k + 1) * ofPlane + n % ofPlane)];
      most = { std::max(most.x, one.x), std::max(most.y, one.y),
        k < ofLayer.last ? std::max(most.z, one.z) : most.z };
    }
    const Vec3<double> slope{ static_cast<double>(most.x), static_cast<double>(most.y),
      static_cast<double>(most.z) };
    const auto middle = [&](std::size_t axis)
    { return (static_cast<double>(at[axis]) + 0.5) * static_cast<double>(slopeEdge); };
    medium.steepest.include({ length(slope), { middle(0), middle(1), middle(2) } });
    medium.slope.x = std::max(medium.slope.x, slope.x);
    medium.slope.y = std::max(medium.slope.y, slope.y);
    medium.slope.z = std::max(medium.slope.z, slope.z);
  }
}

template void findBounds(Medium<float>&, int);
template void findBounds(Medium<double>&, int);

} // namespace schlieren
