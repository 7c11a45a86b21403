// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is known of bricks before they are sampled, and who makes them.
#include "Medium/Tree/BrickOutline.h"

#include "Device/Parallel.h"
#include "Medium/Tree/BrickErrors.h"
#include "Medium/Tree/BrickMakers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace schlieren
{

/// Whether voxels are much finer than cells, so that edges, which are linear in their distances, show nothing new.
template <class Real>
bool BrickMaker<Real>::areEdgesFine(int level, const MediumSource::Content& content) const
{
  const std::array<double, 3> voxel = voxelOf(level);
  bool areFine = true;
  for (std::size_t axis = 0; axis < axes(); ++axis)
  {
    areFine = areFine && !(voxel[axis] > edgeVoxelByCell * content.cellSize[axis]);
  }
  return areFine;
}

template <class Real>
typename BrickMaker<Real>::Outline BrickMaker<Real>::outlineOf(const BrickRequest& request) const
{
  const NodePlace& place = request.place;
  Outline outline{ boxWithApron(place), {}, 0, 0, false, false, {} };
  Brick<Real>& brick = outline.brick;
  outline.content = source_.contentOf(outline.box);
  const MediumSource::Content& content = outline.content;
  const bool hasData = content.hasGas && content.lowest <= content.highest;
  if (!hasData && !(content.hasWall && content.hasWindow))
  {
    brick.kind = content.hasWall ? Leaf<Real>::Solid : Leaf<Real>::Constant;
    return outline;
  }
  outline.lowest = hasData ? nuOf(content.lowest) : 0;
  outline.highest = hasData ? nuOf(content.highest) : 0;
  const double allowed = place.level < 0 ? 0 : request.negligible;
  if (!content.hasWall)
  {
    const double low = content.hasWindow ? std::min(outline.lowest, 0.) : outline.lowest;
    const double high = content.hasWindow ? std::max(outline.highest, 0.) : outline.highest;
    if (deflectionByRange * (high - low) <= allowed)
    {
      brick.facts.neglected = deflectionByRange * (high - low);
      brick.facts.difference = high - low;
      brick.facts.largestNu = std::max(std::abs(low), std::abs(high));
      brick.offset = content.hasWindow ? Real(0) : static_cast<Real>(0.5 * (low + high));
      return outline;
    }
  }
  const bool isDivided = request.dividesAtWalls && content.hasWall && !content.hasWindow &&
    !content.areWallsFlat && !areEdgesFine(place.level, content);
  if (place.level < 0 || isDivided)
  {
    brick.facts.isTooLarge = true;
    return outline;
  }
  outline.hasEdges = content.hasWall || content.hasWindow;
  outline.isSampled = true;
  return outline;
}

template <class Real>
std::vector<Brick<Real>> BrickMaker<Real>::makeTogether(
  const std::vector<BrickRequest>& requests) const
{
  std::vector<Brick<Real>> made;
  if (const BrickMakers* makers = source_.makers())
  {
    for (const std::vector<char>& bytes : makers->make(rules_, requests))
    {
      made.push_back(Brick<Real>::fromBytes(bytes, static_cast<std::size_t>(samplesPerBrick())));
    }
  }
  return made;
}

template <class Real>
std::vector<std::vector<char>> BrickMaker<Real>::makeShare(
  const std::vector<BrickRequest>& requests, std::size_t process, std::size_t processes,
  int threads) const
{
  const auto forEach = [threads](std::size_t count, const auto& work)
  {
    parallelFor(static_cast<std::int64_t>(count), 1, threads,
      [&](std::int64_t first, std::int64_t last)
      {
        for (auto n = static_cast<std::size_t>(first); n < static_cast<std::size_t>(last); ++n)
        {
          work(n);
        }
      });
  };
  std::vector<Box> boxes;
  for (const BrickRequest& request : requests)
  {
    boxes.push_back(boxWithApron(request.place));
  }
  source_.prepareContents(boxes);
  std::vector<Outline> outlines(requests.size());
  forEach(requests.size(), [&](std::size_t n) { outlines[n] = outlineOf(requests[n]); });
  const std::vector<Sampled> sampled = sampledOf(requests, outlines);
  std::vector<Lattice> lattices;
  std::vector<std::size_t> own;
  for (std::size_t n = 0; n < sampled.size(); ++n)
  {
    lattices.push_back(latticeOf(sampled[n]));
    if (n % processes == process)
    {
      own.push_back(n);
    }
  }
  source_.prepareSamples(lattices);
  std::vector<std::vector<char>> made(requests.size());
  for (std::size_t n = 0; n < requests.size() && process == 0; ++n)
  {
    made[n] = outlines[n].isSampled ? std::vector<char>() : outlines[n].brick.toBytes();
  }
  forEach(own.size(),
    [&](std::size_t i)
    {
      makeSampled(sampled[own[i]], requests, outlines);
      for (const std::size_t n : sampled[own[i]].bricks)
      {
        made[n] = outlines[n].brick.toBytes();
      }
    });
  return made;
}

template bool BrickMaker<float>::areEdgesFine(int, const MediumSource::Content&) const;
template bool BrickMaker<double>::areEdgesFine(int, const MediumSource::Content&) const;
template BrickMaker<float>::Outline BrickMaker<float>::outlineOf(const BrickRequest&) const;
template BrickMaker<double>::Outline BrickMaker<double>::outlineOf(const BrickRequest&) const;
template std::vector<Brick<float>> BrickMaker<float>::makeTogether(
  const std::vector<BrickRequest>&) const;
template std::vector<std::vector<char>> BrickMaker<float>::makeShare(
  const std::vector<BrickRequest>&, std::size_t, std::size_t, int) const;
template std::vector<Brick<double>> BrickMaker<double>::makeTogether(
  const std::vector<BrickRequest>&) const;
template std::vector<std::vector<char>> BrickMaker<double>::makeShare(
  const std::vector<BrickRequest>&, std::size_t, std::size_t, int) const;

} // namespace schlieren
