// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/PartOfTree.h"

#include "Device/Parallel.h"
#include "Medium/CountedBytes.h"
#include "Medium/Prefilter.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace schlieren
{

namespace
{

/// Of a part: address space, so that it need not be moved while it grows.
constexpr std::size_t usualBytes = std::size_t{ 1 } << 30;

} // namespace

template <class Real>
std::vector<char> DeliveredBricks<Real>::toBytes() const
{
  std::vector<char> bytes;
  appendCounted(samplesNumbers, bytes);
  appendCounted(mapNumbers, bytes);
  appendCounted(gradientNumbers, bytes);
  appendCounted(samples, bytes);
  appendCounted(maps, bytes);
  appendCounted(gradients, bytes);
  return bytes;
}

template <class Real>
PartOfTree<Real>::PartOfTree(const BrickLayout& layout)
  : layout_(layout)
  , samples_({ static_cast<std::size_t>(layout.samplesPerBrick), 1,
      PaddedVolume<Real>::readTogether, usualBytes })
  , maps_({ static_cast<std::size_t>(layout.samplesPerBrick), 0, 0, usualBytes })
  , gradients_({ static_cast<std::size_t>(layout.samplesPerBrick * std::max(1, layout.fields)),
      layout.fields > 0 ? std::size_t{ 1 } : 0, 0, layout.fields > 0 ? usualBytes : 0 })
{
}

template <class Real>
bool PartOfTree<Real>::put(const char* bricks, std::size_t size)
{
  // From the message into their places: there is no memory for all of them twice.
  const auto take = [&](auto value, std::uint64_t& count)
  { return takeCounted<decltype(value)>(bricks, size, count); };
  std::uint64_t ofSamples = 0, ofMaps = 0, ofGradients = 0, samples = 0, maps = 0, gradients = 0;
  const char* const samplesNumbers = take(std::int32_t{}, ofSamples);
  const char* const mapNumbers = samplesNumbers ? take(std::int32_t{}, ofMaps) : nullptr;
  const char* const gradientNumbers = mapNumbers ? take(std::int32_t{}, ofGradients) : nullptr;
  const char* const firstSample = gradientNumbers ? take(Real{}, samples) : nullptr;
  const char* const firstMap = firstSample ? take(std::int16_t{}, maps) : nullptr;
  const char* const firstGradient = firstMap ? take(float{}, gradients) : nullptr;
  const auto perBrick = static_cast<std::uint64_t>(layout_.samplesPerBrick);
  if (!firstGradient || samples != ofSamples * perBrick || maps != ofMaps * perBrick ||
    gradients != ofGradients * perBrick * static_cast<std::uint64_t>(layout_.fields))
  {
    return false;
  }
  const auto putAll = [](const char* numbers, std::uint64_t count, const char* values, auto& store)
  {
    for (std::uint64_t n = 0; n < count; ++n)
    {
      std::int32_t number = 0;
      std::memcpy(&number, numbers + n * sizeof(number), sizeof(number));
      store.put(number, values + n * store.bytesOfBrick());
    }
  };
  putAll(samplesNumbers, ofSamples, firstSample, samples_);
  putAll(mapNumbers, ofMaps, firstMap, maps_);
  putAll(gradientNumbers, ofGradients, firstGradient, gradients_);
  return true;
}

template <class Real>
bool PartOfTree<Real>::sumUp(
  const std::vector<LeafSegment>& segments, std::vector<LeafSums>& sums, int threads) const
{
  sums.assign(segments.size(), {});
  std::atomic<bool> areAllHere{ true };
  const auto ofBrick = [](const auto& store, std::int32_t brick)
  {
    return brick >= 0 &&
      (static_cast<std::size_t>(brick) + 1) * store.bytesOfBrick() <=
      store.values().size() * sizeof(store.values()[0]);
  };
  parallelFor(static_cast<std::int64_t>(segments.size()), 256, threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n)
      {
        const LeafSegment& segment = segments[n];
        if (!ofBrick(samples_, segment.brick) ||
          (segment.map >= 0 && !ofBrick(maps_, segment.map)) ||
          (segment.gradients != 0 && !ofBrick(gradients_, segment.gradients)))
        {
          areAllHere = false;
          return;
        }
        sums[n] = schlieren::sumUp(
          layout_, samples().data(), gasDistances().data(), gradientValues().data(), segment);
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
