// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/BrickStore.h"

#include "Medium/Prefilter.h"

#include <algorithm>
#include <new>

namespace schlieren
{

namespace
{

/// Address space that is asked for at once; what is not used of it costs nothing.
constexpr std::size_t mostReserved = std::size_t{ 1 } << 30;

/// Zeros behind the last brick.
template <class Real>
constexpr auto behind = static_cast<std::size_t>(PaddedVolume<Real>::readTogether);

template <class Value>
auto pieceOf(std::vector<Value>& values, std::size_t size, std::int32_t n)
{
  return values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(n) * size);
}

/// Puts what is in place order[n] into place n, for pieces of `size` values.
template <class Value>
void permute(std::vector<Value>& values, std::size_t size, const std::vector<std::int32_t>& order)
{
  std::vector<Value> first(size);
  std::vector<bool> isDone(order.size(), false);
  for (std::size_t n = 0; n < order.size(); ++n)
  {
    const auto start = static_cast<std::int32_t>(n);
    if (isDone[n] || order[n] == start)
    {
      continue;
    }
    std::copy_n(pieceOf(values, size, start), size, first.begin());
    std::int32_t to = start;
    while (order[static_cast<std::size_t>(to)] != start)
    {
      const std::int32_t from = order[static_cast<std::size_t>(to)];
      std::copy_n(pieceOf(values, size, from), size, pieceOf(values, size, to));
      isDone[static_cast<std::size_t>(to)] = true;
      to = from;
    }
    std::copy_n(first.begin(), size, pieceOf(values, size, to));
    isDone[static_cast<std::size_t>(to)] = true;
  }
}

/// The numbers that are used, in this order, and then all others below `count`.
std::vector<std::int32_t> completed(std::vector<std::int32_t> used, std::size_t count)
{
  std::vector<bool> isUsed(count, false);
  for (const std::int32_t n : used)
  {
    isUsed[static_cast<std::size_t>(n)] = true;
  }
  for (std::size_t n = 0; n < count; ++n)
  {
    if (!isUsed[n])
    {
      used.push_back(static_cast<std::int32_t>(n));
    }
  }
  return used;
}

} // namespace

template <class Real>
BrickStore<Real>::BrickStore(std::int64_t samplesPerBrick, std::size_t usual)
  : perBrick_(static_cast<std::size_t>(samplesPerBrick))
  , usual_(usual)
{
  clear();
}

template <class Real>
void BrickStore<Real>::clear()
{
  samples_.assign(perBrick_ + behind<Real>, Real(0));
  gasDistances_.clear();
  freeBricks_.clear();
  freeMaps_.clear();
}

template <class Real>
void BrickStore<Real>::reserve(std::size_t samples)
{
  if (samples <= samples_.capacity())
  {
    return;
  }
  const std::size_t atOnce = std::min(usual_, mostReserved) / sizeof(Real);
  try
  {
    samples_.reserve(std::max({ samples, atOnce, 2 * samples_.size() }));
    askForHugePages(samples_.data(), samples_.capacity() * sizeof(Real));
  }
  catch (const std::bad_alloc&)
  {
    // What is needed now may be there all the same.
  }
}

template <class Real>
std::int32_t BrickStore<Real>::addBrick(const std::vector<Real>& samples)
{
  std::int32_t brick;
  if (freeBricks_.empty())
  {
    const std::size_t needed = samples_.size() + perBrick_;
    reserve(needed);
    brick = static_cast<std::int32_t>((samples_.size() - behind<Real>) / perBrick_);
    samples_.resize(needed);
  }
  else
  {
    brick = freeBricks_.back();
    freeBricks_.pop_back();
  }
  std::copy(samples.begin(), samples.end(), pieceOf(samples_, perBrick_, brick));
  return brick;
}

template <class Real>
std::int32_t BrickStore<Real>::addMap(const std::vector<std::int16_t>& distances)
{
  std::int32_t map;
  if (freeMaps_.empty())
  {
    map = static_cast<std::int32_t>(gasDistances_.size() / perBrick_);
    gasDistances_.resize(gasDistances_.size() + perBrick_);
  }
  else
  {
    map = freeMaps_.back();
    freeMaps_.pop_back();
  }
  std::copy(distances.begin(), distances.end(), pieceOf(gasDistances_, perBrick_, map));
  return map;
}

template <class Real>
void BrickStore<Real>::arrange(
  const std::vector<std::int32_t>& bricks, const std::vector<std::int32_t>& maps)
{
  permute(samples_, perBrick_, completed(bricks, (samples_.size() - behind<Real>) / perBrick_));
  permute(gasDistances_, perBrick_, completed(maps, gasDistances_.size() / perBrick_));
  samples_.resize(bricks.size() * perBrick_);
  samples_.resize(bricks.size() * perBrick_ + behind<Real>, Real(0));
  gasDistances_.resize(maps.size() * perBrick_);
  freeBricks_.clear();
  freeMaps_.clear();
}

template <class Real>
std::size_t BrickStore<Real>::bytesUsed() const
{
  return samples_.size() * sizeof(Real) + gasDistances_.size() * sizeof(std::int16_t) -
    freeBricks_.size() * bytesOfBrick() - freeMaps_.size() * bytesOfMap();
}

template class BrickStore<float>;
template class BrickStore<double>;

} // namespace schlieren
