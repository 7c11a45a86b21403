// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "AmrOwners.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>

namespace filters
{

namespace
{

using Owners = std::vector<std::uint64_t>; // of each image

/// Cells of the same levels that ranks need of each other.
double copiesBetween(const AmrLevels& levels, const Owners& owners, int margin)
{
  double copies = 0;
  for (const AmrLevel& level : levels.levels)
  {
    const BoxBins bins = binsOf(level);
    for (const AmrBlock& block : level.blocks)
    {
      CellBox around = boxOf(block);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        around.begin[axis] -= margin;
        around.end[axis] += margin;
      }
      bins.forPartsIn(around,
        [&](std::size_t other, const CellBox& part)
        {
          const bool isElsewhere = owners[level.blocks[other].leaf] != owners[block.leaf];
          copies += isElsewhere ? static_cast<double>(volume(part.size())) : 0;
        });
    }
  }
  return copies;
}

/// The place of a point on the curve of Morton (1966) through the domain.
std::uint64_t placeOnCurve(const std::array<double, 3>& point, const std::array<double, 3>& size)
{
  constexpr int bits = 20;
  std::uint64_t place = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double part = std::clamp(point[axis] / size[axis], 0., 1.);
    const auto at = static_cast<std::uint64_t>(part * ((1 << bits) - 1));
    for (int bit = 0; bit < bits; ++bit)
    {
      place |= (at >> bit & 1) << (3 * bit + static_cast<int>(axis));
    }
  }
  return place;
}

struct ImageOnCurve
{
  std::uint64_t place = 0, image = 0;
  double cells = 0;
};

std::vector<ImageOnCurve> alongCurve(const AmrLevels& levels)
{
  std::vector<ImageOnCurve> images;
  const AmrLevel& coarsest = levels.levels[0];
  std::array<double, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    size[axis] = coarsest.spacing[axis] * coarsest.cells[axis];
  }
  for (const AmrLevel& level : levels.levels)
  {
    for (const AmrBlock& block : level.blocks)
    {
      std::array<double, 3> middle{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        middle[axis] = level.spacing[axis] * (block.first[axis] + block.cells[axis] / 2.);
      }
      images.push_back(
        { placeOnCurve(middle, size), block.leaf, static_cast<double>(volume(block.cells)) });
    }
  }
  std::sort(images.begin(), images.end(),
    [](const ImageOnCurve& a, const ImageOnCurve& b)
    { return std::pair(a.place, a.image) < std::pair(b.place, b.image); });
  return images;
}

} // namespace

std::optional<std::vector<std::uint64_t>> betterOwners(
  const AmrLevels& levels, const std::vector<std::uint64_t>& firstImages, int margin)
{
  Owners now(firstImages.back());
  std::vector<std::uint64_t> ranks; // that have any
  for (std::uint64_t rank = 0; rank + 1 < firstImages.size(); ++rank)
  {
    std::fill(now.begin() + static_cast<std::ptrdiff_t>(firstImages[rank]),
      now.begin() + static_cast<std::ptrdiff_t>(firstImages[rank + 1]), rank);
    if (firstImages[rank] < firstImages[rank + 1])
    {
      ranks.push_back(rank);
    }
  }
  const std::vector<ImageOnCurve> images = alongCurve(levels);
  double all = 0;
  for (const ImageOnCurve& image : images)
  {
    all += image.cells;
  }
  std::vector<std::size_t> parts(now.size());
  std::map<std::pair<std::size_t, std::uint64_t>, double> common; // cells, by part and rank
  double before = 0;
  for (const ImageOnCurve& image : images)
  {
    const double place = (before + image.cells / 2) / all * static_cast<double>(ranks.size());
    const std::size_t part = std::min(static_cast<std::size_t>(place), ranks.size() - 1);
    parts[image.image] = part;
    common[{ part, now[image.image] }] += image.cells;
    before += image.cells;
  }
  // Each part to the rank that has most of it already.
  std::vector<std::pair<double, std::pair<std::size_t, std::uint64_t>>> pairs;
  for (const auto& [pair, cells] : common)
  {
    pairs.push_back({ -cells, pair });
  }
  std::sort(pairs.begin(), pairs.end());
  std::map<std::size_t, std::uint64_t> rankOf;
  std::vector<std::uint64_t> left = ranks;
  for (const auto& [cells, pair] : pairs)
  {
    const auto at = std::find(left.begin(), left.end(), pair.second);
    if (rankOf.count(pair.first) == 0 && at != left.end())
    {
      rankOf[pair.first] = pair.second;
      left.erase(at);
    }
  }
  Owners better = now;
  for (const ImageOnCurve& image : images)
  {
    const std::size_t part = parts[image.image];
    if (rankOf.count(part) == 0)
    {
      rankOf[part] = left.back();
      left.pop_back();
    }
    better[image.image] = rankOf[part];
  }
  const bool isWorth =
    copiesBetween(levels, better, margin) < 0.5 * copiesBetween(levels, now, margin);
  return isWorth ? std::optional(better) : std::nullopt;
}

} // namespace filters
