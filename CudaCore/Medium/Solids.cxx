// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Solids.h"

#include <algorithm>

namespace schlieren
{

namespace
{

/// Calls visit(index) for the up to 26 neighbours of a point that lie within the grid.
template <class Real, class Visit>
void forNeighbours(const PaddedVolume<Real>& volume, std::int64_t at, const Visit& visit)
{
  const auto [nx, ny, nz] = volume.dimensions;
  const std::int64_t k = at / volume.strides[2] - 1;
  const std::int64_t j = at % volume.strides[2] / volume.strides[1] - 1;
  const std::int64_t i = at % volume.strides[1] - 1;
  for (std::int64_t kk = std::max<std::int64_t>(k - 1, 0); kk <= std::min(k + 1, nz - 1); ++kk)
  {
    for (std::int64_t jj = std::max<std::int64_t>(j - 1, 0); jj <= std::min(j + 1, ny - 1); ++jj)
    {
      for (std::int64_t ii = std::max<std::int64_t>(i - 1, 0); ii <= std::min(i + 1, nx - 1); ++ii)
      {
        const std::int64_t neighbour = volume.index(ii, jj, kk);
        if (neighbour != at)
        {
          visit(neighbour);
        }
      }
    }
  }
}

} // namespace

template <class Real>
void fillEmpty(PaddedVolume<Real>& volume, std::vector<std::uint32_t> empty)
{
  std::vector<std::uint32_t> queued(empty.size(), 0);
  std::vector<std::int64_t> layer;

  const auto [nx, ny, nz] = volume.dimensions;
  for (std::int64_t k = 0; k < nz; ++k)
  {
    for (std::int64_t j = 0; j < ny; ++j)
    {
      for (std::int64_t i = 0; i < nx; ++i)
      {
        const std::int64_t at = volume.index(i, j, k);
        bool touchesGas = false;
        if (bitAt(empty, at))
        {
          forNeighbours(volume, at, [&](std::int64_t n) { touchesGas |= !bitAt(empty, n); });
        }
        if (touchesGas)
        {
          setBit(queued, at, true);
          layer.push_back(at);
        }
      }
    }
  }

  std::vector<std::int64_t> nextLayer;
  std::vector<Real> values;
  while (!layer.empty())
  {
    values.clear();
    for (const std::int64_t at : layer)
    {
      // Relative to one of them, so that the mean of equal values is exactly that value.
      double first = 0, excess = 0;
      int count = 0;
      forNeighbours(volume, at,
        [&](std::int64_t n)
        {
          if (!bitAt(empty, n))
          {
            const double value = static_cast<double>(volume.samples[static_cast<std::size_t>(n)]);
            first = count == 0 ? value : first;
            excess += value - first;
            ++count;
          }
        });
      values.push_back(static_cast<Real>(first + excess / count));
    }
    for (std::size_t n = 0; n < layer.size(); ++n)
    {
      volume.samples[static_cast<std::size_t>(layer[n])] = values[n];
      setBit(empty, layer[n], false);
    }
    nextLayer.clear();
    for (const std::int64_t at : layer)
    {
      forNeighbours(volume, at,
        [&](std::int64_t n)
        {
          if (bitAt(empty, n) && !bitAt(queued, n))
          {
            setBit(queued, n, true);
            nextLayer.push_back(n);
          }
        });
    }
    layer.swap(nextLayer);
  }
}

template void fillEmpty(PaddedVolume<float>&, std::vector<std::uint32_t>);
template void fillEmpty(PaddedVolume<double>&, std::vector<std::uint32_t>);

} // namespace schlieren
