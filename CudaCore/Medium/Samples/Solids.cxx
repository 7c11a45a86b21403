// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Samples/Solids.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace schlieren
{

namespace
{

/// Layers behind a wall on which splines in the gas depend. The gas ends less than a voxel from its last sample; there
/// splines, quadratic and cubic, have coefficients up to two voxels from that sample, and these depend on the next one.
constexpr int layersOfSplines = 3;

/// The n-th words of the rows around (j, k): the points of which a neighbour has a value.
std::uint64_t besideValues(const PointMask& empty, std::int64_t n, std::int64_t j, std::int64_t k)
{
  const auto [nx, ny, nz] = empty.dimensions;
  std::uint64_t beside = 0;
  for (std::int64_t kk = std::max<std::int64_t>(k - 1, 0); kk <= std::min(k + 1, nz - 1); ++kk)
  {
    for (std::int64_t jj = std::max<std::int64_t>(j - 1, 0); jj <= std::min(j + 1, ny - 1); ++jj)
    {
      const std::uint64_t* row = empty.row(jj, kk);
      const std::uint64_t value = ~row[n];
      const std::uint64_t before = n > 0 ? ~row[n - 1] : 0;
      const std::uint64_t behind = n + 1 < empty.wordsPerRow ? ~row[n + 1] : 0;
      beside |= value | value << 1 | before >> 63 | value >> 1 | behind << 63;
    }
  }
  return beside;
}

/// The one of two slopes that is less steep; 0 where they have different signs.
double gentler(double a, double b) { return a * b > 0 ? (std::abs(a) < std::abs(b) ? a : b) : 0; }

/// Whether point i of a row has a value; and bits 0 to 2: whether i - 1, i, and i + 1 have. There is none beyond the row.
inline bool hasValue(const std::uint64_t* row, std::int64_t i)
{
  return ((row[i >> 6] >> (i & 63)) & 1) == 0;
}
inline unsigned valuesAround(const std::uint64_t* row, std::int64_t wordsPerRow, std::int64_t i)
{
  const std::int64_t n = i >> 6, bit = i & 63;
  const std::uint64_t values = ~row[n];
  const std::uint64_t before = bit > 0 ? values >> (bit - 1) : values << 1;
  unsigned around = static_cast<unsigned>(before & 7);
  if (bit == 0 && n > 0)
  {
    around |= static_cast<unsigned>(~row[n - 1] >> 63);
  }
  if (bit == 63 && n + 1 < wordsPerRow)
  {
    around |= static_cast<unsigned>((~row[n + 1] & 1) << 2);
  }
  return around;
}

/// Mean of the neighbours that have a value or, in a linear continuation, of what lines through three points that have one
/// lead to, where there are any. The gentler of a line's two slopes counts: voxels may be larger than a layer at a wall,
/// whose slope leads anywhere.
template <class Real>
Real valueFromAround(const PaddedVolume<Real>& volume, const PointMask& empty, std::int64_t i,
  std::int64_t j, std::int64_t k, Continuation continuation)
{
  const std::array<std::int64_t, 3>& n = volume.dimensions;
  const auto isWithin = [&](std::int64_t jj, std::int64_t kk)
  { return jj >= 0 && jj < n[1] && kk >= 0 && kk < n[2]; };
  // Relative to one of them, so that the mean of equal values is exactly that value.
  struct Mean
  {
    double first = 0, excess = 0;
    int count = 0;
    void add(double value)
    {
      first = count == 0 ? value : first;
      excess += value - first;
      ++count;
    }
  };
  Mean ofNeighbours, ofLines;
  const Real* const here = volume.samples.data() + volume.index(i, j, k);
  for (int dk = -1; dk <= 1; ++dk)
  {
    for (int dj = -1; dj <= 1; ++dj)
    {
      const unsigned around = isWithin(j + dj, k + dk)
        ? valuesAround(empty.row(j + dj, k + dk), empty.wordsPerRow, i)
        : 0;
      if (around == 0)
      {
        continue;
      }
      const bool hasLines =
        continuation == Continuation::Linear && isWithin(j + 3 * dj, k + 3 * dk);
      const std::uint64_t* const second = hasLines ? empty.row(j + 2 * dj, k + 2 * dk) : nullptr;
      const std::uint64_t* const third = hasLines ? empty.row(j + 3 * dj, k + 3 * dk) : nullptr;
      for (int di = -1; di <= 1; ++di)
      {
        if ((around >> (di + 1) & 1u) == 0)
        {
          continue;
        }
        const std::int64_t step = volume.index(i + di, j + dj, k + dk) - volume.index(i, j, k);
        const auto value = static_cast<double>(here[step]);
        ofNeighbours.add(value);
        if (hasLines && i + 3 * di >= 0 && i + 3 * di < n[0] && hasValue(second, i + 2 * di) &&
          hasValue(third, i + 3 * di))
        {
          const auto next = static_cast<double>(here[2 * step]);
          ofLines.add(value + gentler(value - next, next - static_cast<double>(here[3 * step])));
        }
      }
    }
  }
  const Mean& mean = ofLines.count > 0 ? ofLines : ofNeighbours;
  return static_cast<Real>(mean.first + mean.excess / mean.count);
}

/// Fills layers, at most so many. Returns the points that are left.
template <class Real>
PointMask fillLayers(
  PaddedVolume<Real>& volume, PointMask empty, int threads, Continuation continuation, int most)
{
  PointMask next = empty; // those left when a layer has been filled
  const std::int64_t ny = volume.dimensions[1];
  std::atomic<bool> isDone{ false };
  for (int filled = 0; filled < most && !isDone; ++filled)
  {
    isDone = true;
    parallelFor(volume.dimensions[2], 1, threads,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t k = begin; k < end; ++k)
        {
          for (std::int64_t j = 0; j < ny; ++j)
          {
            for (std::int64_t n = 0; n < empty.wordsPerRow; ++n)
            {
              const std::uint64_t left = empty.row(j, k)[n];
              std::uint64_t layer = left & empty.pointsOf(n);
              layer = layer == 0 ? 0 : layer & besideValues(empty, n, j, k);
              next.row(j, k)[n] = left & ~layer;
              for (std::int64_t i = 64 * n; layer != 0; ++i, layer >>= 1)
              {
                if ((layer & 1) != 0)
                {
                  volume.at(i, j, k) = valueFromAround(volume, empty, i, j, k, continuation);
                  isDone = false;
                }
              }
            }
          }
        }
      });
    std::swap(empty, next);
  }
  return empty;
}

/// Gives values to points of a line that have none: between two others they change evenly.
template <class HasValue, class Set>
void bridge(int points, const HasValue& hasValueAt, const Set& set)
{
  int last = -1;
  for (int i = 0; i <= points; ++i)
  {
    if (i < points && !hasValueAt(i))
    {
      continue;
    }
    for (int gap = last + 1; gap < i && (last >= 0 || i < points); ++gap)
    {
      const int before = last >= 0 ? last : i, behind = i < points ? i : last;
      set(gap, before, behind, before == behind ? 0 : double(gap - before) / (behind - before));
    }
    last = i;
  }
}

/// Gives values to the points that are left of a brick, n by n by `layers`, on which nothing depends: along rows, then to
/// rows that have none, then to layers.
void fillRest(std::vector<double>& values, int n, int layers, const PointMask& empty)
{
  const std::uint64_t all = empty.pointsOf(0);
  const auto at = [&](int j, int k) { return values.data() + (k * n + j) * std::ptrdiff_t{ n }; };
  const auto mix = [](double* to, const double* a, const double* b, double share, int count)
  {
    for (int i = 0; i < count; ++i)
    {
      to[i] = a[i] + share * (b[i] - a[i]);
    }
  };
  std::vector<bool> hasRow(static_cast<std::size_t>(n));
  std::vector<bool> hasLayer(static_cast<std::size_t>(layers), false);
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      const std::uint64_t* row = empty.row(j, k);
      const bool hasAny = (*row & all) != all;
      hasRow[static_cast<std::size_t>(j)] = hasAny;
      hasLayer[static_cast<std::size_t>(k)] = hasLayer[static_cast<std::size_t>(k)] || hasAny;
      if (hasAny && (*row & all) != 0)
      {
        double* v = at(j, k);
        bridge(
          n, [&](int i) { return hasValue(row, i); },
          [&](int i, int a, int b, double share) { mix(v + i, v + a, v + b, share, 1); });
      }
    }
    bridge(
      n, [&](int j) { return hasRow[static_cast<std::size_t>(j)]; },
      [&](int j, int a, int b, double share) { mix(at(j, k), at(a, k), at(b, k), share, n); });
  }
  bridge(
    layers, [&](int k) { return hasLayer[static_cast<std::size_t>(k)]; },
    [&](int k, int a, int b, double share) { mix(at(0, k), at(0, a), at(0, b), share, n * n); });
}

} // namespace

template <class Real>
void fillEmpty(PaddedVolume<Real>& volume, PointMask empty, int threads, Continuation continuation)
{
  constexpr int all = std::numeric_limits<int>::max();
  if (continuation == Continuation::Linear)
  {
    empty = fillLayers(volume, std::move(empty), threads, continuation, layersOfSplines);
  }
  fillLayers(volume, std::move(empty), threads, Continuation::Constant, all);
}

void continueValues(
  std::vector<double>& values, int n, int layers, const std::vector<unsigned char>& isKnown)
{
  PaddedVolume<double> volume({ n, n, layers });
  PointMask empty({ n, n, layers });
  const unsigned char* known = isKnown.data();
  double* row = values.data();
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < n; ++j, row += n, known += n)
    {
      std::uint64_t bits = 0; // one word a row
      for (int i = 0; i < n; ++i)
      {
        bits |= std::uint64_t{ known[i] } << i;
      }
      *empty.row(j, k) = ~bits;
      std::copy_n(row, n, &volume.at(0, j, k));
    }
  }
  empty = fillLayers(volume, std::move(empty), 1, Continuation::Linear, layersOfSplines);
  row = values.data();
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < n; ++j, row += n)
    {
      std::copy_n(&volume.at(0, j, k), n, row);
    }
  }
  fillRest(values, n, layers, empty);
}

template <class Real>
std::vector<std::uint32_t> bitsPerSample(const PaddedVolume<Real>& volume, const PointMask& mask)
{
  std::vector<std::uint32_t> bits((volume.samples.size() + 31) / 32, 0);
  for (std::int64_t k = 0; k < mask.dimensions[2]; ++k)
  {
    for (std::int64_t j = 0; j < mask.dimensions[1]; ++j)
    {
      for (std::int64_t n = 0; n < mask.wordsPerRow; ++n)
      {
        std::uint64_t word = mask.row(j, k)[n] & mask.pointsOf(n);
        const std::int64_t at = volume.index(64 * n, j, k);
        auto to = static_cast<std::size_t>(at >> 5);
        const int shift = static_cast<int>(at & 31);
        if (word != 0)
        {
          bits[to] |= static_cast<std::uint32_t>(word << shift);
          for (word >>= 32 - shift; word != 0; word >>= 32)
          {
            bits[++to] |= static_cast<std::uint32_t>(word);
          }
        }
      }
    }
  }
  return bits;
}

template void fillEmpty(PaddedVolume<float>&, PointMask, int, Continuation);
template void fillEmpty(PaddedVolume<double>&, PointMask, int, Continuation);
template std::vector<std::uint32_t> bitsPerSample(const PaddedVolume<float>&, const PointMask&);
template std::vector<std::uint32_t> bitsPerSample(const PaddedVolume<double>&, const PointMask&);

} // namespace schlieren
