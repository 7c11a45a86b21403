// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Samples/Solids.h"

#include "Device/Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace schlieren
{

namespace
{

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

} // namespace

template <class Real>
void fillEmpty(PaddedVolume<Real>& volume, PointMask empty, int threads, Continuation continuation)
{
  PointMask next = empty; // those left when a layer has been filled
  const std::int64_t ny = volume.dimensions[1];
  std::atomic<bool> isDone{ false };
  while (!isDone)
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
  fillEmpty(volume, std::move(empty), 1, Continuation::Linear);
  row = values.data();
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < n; ++j, row += n)
    {
      std::copy_n(&volume.at(0, j, k), n, row);
    }
  }
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
