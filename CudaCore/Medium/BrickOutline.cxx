// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is known of bricks before they are sampled, and who makes them.
#include "Medium/BrickOutline.h"

#include "Device/Parallel.h"
#include "Medium/BrickErrors.h"
#include "Medium/BrickMakers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace schlieren
{

template <class Real>
typename BrickMaker<Real>::Outline BrickMaker<Real>::outlineOf(
  const NodePlace& place, const Negligible& negligible) const
{
  Outline outline{ boxWithApron(place), {}, 0, 0, false, false, false, {} };
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
  const double gathered = hasData ? largestGathered(source_, outline.box) : 0;
  const Negligible allowed = place.level < 0 ? Negligible{ 0 } : negligible;
  outline.hasFields = gathered > allowed.gathered;
  brick.fields.facts.neglected = outline.hasFields ? 0 : gathered;
  if (!content.hasWall && !outline.hasFields)
  {
    const double low = content.hasWindow ? std::min(outline.lowest, 0.) : outline.lowest;
    const double high = content.hasWindow ? std::max(outline.highest, 0.) : outline.highest;
    if (deflectionByRange * (high - low) <= allowed.deflection)
    {
      brick.facts.neglected = deflectionByRange * (high - low);
      brick.facts.difference = high - low;
      brick.facts.largestNu = std::max(std::abs(low), std::abs(high));
      brick.offset = content.hasWindow ? Real(0) : static_cast<Real>(0.5 * (low + high));
      return outline;
    }
  }
  if (place.level < 0)
  {
    brick.facts.isTooLarge = true;
    return outline;
  }
  outline.hasEdges = content.hasWall || content.hasWindow;
  outline.isSampled = true;
  return outline;
}

template <class Real>
std::vector<Brick<Real>> BrickMaker<Real>::prepare(
  const std::vector<BrickRequest>& bricks, int threads) const
{
  const bool isRemote = source_.isRemote();
  const BrickMakers* const makers = source_.makers();
  std::vector<Brick<Real>> made;
  if (!isRemote && !makers)
  {
    return made;
  }
  std::vector<Box> boxes;
  for (const BrickRequest& brick : bricks)
  {
    boxes.push_back(boxWithApron(brick.place));
  }
  source_.prepareContents(boxes);
  const bool areLatticesFixed = isRemote || source_.dependsOnLattice();
  std::vector<Outline> outlines(bricks.size());
  parallelFor(static_cast<std::int64_t>(bricks.size()), 1, threads,
    [&](std::int64_t first, std::int64_t last)
    {
      for (auto n = static_cast<std::size_t>(first); n < static_cast<std::size_t>(last); ++n)
      {
        outlines[n] = outlineOf(bricks[n].place, bricks[n].negligible);
      }
    });
  std::vector<BrickTask> tasks;
  std::vector<std::size_t> sampled;
  for (std::size_t n = 0; n < bricks.size(); ++n)
  {
    Outline& outline = outlines[n];
    if (outline.isSampled)
    {
      const int margin = areLatticesFixed ? preparedMarginOf(outline.hasEdges, outline.hasFields)
                                          : marginOf(outline.hasEdges, outline.hasFields);
      tasks.push_back({ bricks[n], outline.box, outline.content, latticeOf(bricks[n].place, margin),
        outline.hasEdges });
      sampled.push_back(n);
    }
    made.push_back(std::move(outline.brick));
  }
  if (!makers)
  {
    std::vector<Lattice> lattices;
    for (const BrickTask& task : tasks)
    {
      lattices.push_back(task.lattice);
    }
    source_.prepareSamples(lattices);
    return {};
  }
  std::vector<unsigned char> isMade(tasks.size(), 0);
  const auto makeHere = [&](const std::vector<std::size_t>& numbers)
  {
    parallelFor(static_cast<std::int64_t>(numbers.size()), 1, threads,
      [&](std::int64_t first, std::int64_t last)
      {
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
        {
          const std::size_t n = numbers[i];
          made[sampled[n]] = make(tasks[n].request.place, tasks[n].request.negligible);
          isMade[n] = 1;
        }
      });
  };
  const std::vector<std::vector<char>> bytes = makers->make(rules_, tasks, makeHere);
  std::vector<std::size_t> left;
  for (std::size_t n = 0; n < tasks.size(); ++n)
  {
    if (!bytes.at(n).empty())
    {
      made[sampled[n]] = Brick<Real>::fromBytes(bytes[n],
        static_cast<std::size_t>(samplesPerBrick()), static_cast<std::size_t>(source_.fields()));
    }
    else if (!isMade[n])
    {
      left.push_back(n);
    }
  }
  makeHere(left);
  return made;
}

template BrickMaker<float>::Outline BrickMaker<float>::outlineOf(
  const NodePlace&, const Negligible&) const;
template BrickMaker<double>::Outline BrickMaker<double>::outlineOf(
  const NodePlace&, const Negligible&) const;
template std::vector<Brick<float>> BrickMaker<float>::prepare(
  const std::vector<BrickRequest>&, int) const;
template std::vector<Brick<double>> BrickMaker<double>::prepare(
  const std::vector<BrickRequest>&, int) const;

} // namespace schlieren
