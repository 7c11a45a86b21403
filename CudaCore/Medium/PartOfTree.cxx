// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/PartOfTree.h"

#include "Device/Parallel.h"
#include "Medium/Prefilter.h"

#include <atomic>
#include <cstring>

namespace schlieren
{

template <class Real>
std::vector<char> DeliveredBricks<Real>::toBytes() const
{
  std::vector<char> bytes;
  const auto append = [&](const auto& values)
  {
    const std::uint64_t count = values.size();
    const std::size_t size = count * sizeof(values[0]);
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof(count) + size);
    std::memcpy(bytes.data() + at, &count, sizeof(count));
    if (size > 0)
    {
      std::memcpy(bytes.data() + at + sizeof(count), values.data(), size);
    }
  };
  append(samplesNumbers);
  append(mapNumbers);
  append(samples);
  append(maps);
  return bytes;
}

template <class Real>
bool DeliveredBricks<Real>::fromBytes(const char* first, std::size_t size)
{
  const auto take = [&](auto& values)
  {
    std::uint64_t count = 0;
    if (size < sizeof(count))
    {
      return false;
    }
    std::memcpy(&count, first, sizeof(count));
    first += sizeof(count);
    size -= sizeof(count);
    if (count > size / sizeof(values[0]))
    {
      return false;
    }
    values.resize(count);
    const std::size_t bytes = count * sizeof(values[0]);
    if (bytes > 0)
    {
      std::memcpy(values.data(), first, bytes);
    }
    first += bytes;
    size -= bytes;
    return true;
  };
  return take(samplesNumbers) && take(mapNumbers) && take(samples) && take(maps);
}

template <class Real>
PartOfTree<Real>::PartOfTree(const BrickLayout& layout)
  : layout_(layout)
  , samples_(
      { static_cast<std::size_t>(layout.samplesPerBrick), 1, PaddedVolume<Real>::readTogether })
  , maps_({ static_cast<std::size_t>(layout.samplesPerBrick) })
{
}

template <class Real>
bool PartOfTree<Real>::put(const char* bricks, std::size_t size)
{
  DeliveredBricks<Real> delivered;
  const auto perBrick = static_cast<std::size_t>(layout_.samplesPerBrick);
  if (!delivered.fromBytes(bricks, size) ||
    delivered.samples.size() != delivered.samplesNumbers.size() * perBrick ||
    delivered.maps.size() != delivered.mapNumbers.size() * perBrick)
  {
    return false;
  }
  for (std::size_t n = 0; n < delivered.samplesNumbers.size(); ++n)
  {
    samples_.put(delivered.samplesNumbers[n], delivered.samples.data() + n * perBrick);
  }
  for (std::size_t n = 0; n < delivered.mapNumbers.size(); ++n)
  {
    maps_.put(delivered.mapNumbers[n], delivered.maps.data() + n * perBrick);
  }
  return true;
}

template <class Real>
bool PartOfTree<Real>::sumUp(
  const std::vector<LeafSegment>& segments, std::vector<LeafSums>& sums, int threads) const
{
  sums.assign(segments.size(), {});
  std::atomic<bool> areAllHere{ true };
  const auto ofBrick = [this](const auto& values, std::int32_t brick)
  {
    return brick >= 0 &&
      (static_cast<std::size_t>(brick) + 1) * static_cast<std::size_t>(layout_.samplesPerBrick) <=
      values.size();
  };
  parallelFor(static_cast<std::int64_t>(segments.size()), 256, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n)
      {
        const LeafSegment& segment = segments[n];
        if (!ofBrick(samples(), segment.brick) ||
          (segment.map >= 0 && !ofBrick(gasDistances(), segment.map)))
        {
          areAllHere = false;
          return;
        }
        sums[n] = schlieren::sumUp(layout_, samples().data(), gasDistances().data(), segment);
      }
    });
  return areAllHere;
}

template <class Real>
bool PartOfTree<Real>::fetch(
  const std::vector<std::int32_t>& bricks, std::vector<char>& found) const
{
  const auto perBrick = static_cast<std::size_t>(layout_.samplesPerBrick);
  const std::size_t bytes = perBrick * sizeof(Real);
  found.resize(bricks.size() * bytes);
  for (std::size_t n = 0; n < bricks.size(); ++n)
  {
    const auto first = static_cast<std::size_t>(bricks[n]) * perBrick;
    if (bricks[n] < 0 || first + perBrick > samples().size())
    {
      return false;
    }
    std::memcpy(found.data() + n * bytes, samples().data() + first, bytes);
  }
  return true;
}

template struct DeliveredBricks<float>;
template struct DeliveredBricks<double>;
template class PartOfTree<float>;
template class PartOfTree<double>;

} // namespace schlieren
