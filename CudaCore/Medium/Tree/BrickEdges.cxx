// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where gas ends in a brick.
#include "Medium/Tree/Brick.h"

#include "Medium/Tree/BrickErrors.h"
#include "Medium/Tree/BrickSamples.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace schlieren
{

namespace
{

constexpr double distanceUnits = 8192;

/// What is beyond the edge next to a point of gas: a window if no neighbour is a wall.
bool endsAtWindow(const BrickSamples& samples, const std::array<int, 3>& point)
{
  const bool isLayer = samples.layers == 1;
  const std::size_t at = samples.index(point[0], point[1], point[2]);
  bool isWindow = samples.places[at] == Place::Window, isBesideWall = false;
  if (samples.places[at] == Place::Gas && samples.distances[at] < 2)
  {
    for (int neighbour = 0; neighbour < (isLayer ? 9 : 27); ++neighbour)
    {
      const Place there = samples.places[samples.index(point[0] + neighbour % 3 - 1,
        point[1] + neighbour / 3 % 3 - 1, isLayer ? 0 : point[2] + neighbour / 9 - 1)];
      isWindow = isWindow || there == Place::Window;
      isBesideWall = isBesideWall || there == Place::Wall;
    }
  }
  return isWindow && !isBesideWall;
}

} // namespace

/// The kind of a leaf that may have walls or windows, its map and what it needs to be finer. Returns whether gas
/// or a window ends in it.
template <class Real>
bool BrickMaker<Real>::findEdges(const NodePlace& place, const MediumSource::Content& content,
  BrickSamples& samples, Brick<Real>& brick) const
{
  bool hasGas = false, hasWall = false, hasWindow = false, hasEdge = false;
  double besideEdge = 0, steepest = 0; // of nu; of its differences, a voxel
  float bend = 0;                      // of distances, in the middle of a voxel
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<std::array<float, 2>, 3> normals;
  normals.fill({ infinity, -infinity });
  const int first = samples.margin - 1;
  const int last = samples.margin + edge;
  const bool isLayer = shape_ == BrickShape::Layer;
  for (int k = isLayer ? 0 : first; k <= (isLayer ? 0 : last); ++k)
  {
    for (int j = first; j <= last; ++j)
    {
      for (int i = first; i <= last; ++i)
      {
        if (!samples.isWithin(i, j, k))
        {
          continue;
        }
        const std::size_t at = samples.index(i, j, k);
        hasGas = hasGas || samples.places[at] == Place::Gas;
        hasWall = hasWall || samples.places[at] == Place::Wall;
        hasWindow = hasWindow || samples.places[at] == Place::Window;
        // Where gas ends with the domain there is no edge: rays end there, too.
        const bool isLast =
          !samples.isWithin(i - 1, j - 1, k - 1) || !samples.isWithin(i + 1, j + 1, k + 1);
        const bool isNear =
          samples.distances[at] > -1 && samples.distances[at] < (isLast ? 0.45f : 1.f);
        hasEdge = hasEdge || isNear;
        if (isNear && !isLast)
        {
          bend = std::max(bend, samples.bendAt(i, j, k));
          samples.addNormal(i, j, k, normals);
        }
        const bool isGas = samples.places[at] == Place::Gas;
        if (isGas && (isNear || (isLast && samples.isBesideWindow(i, j, k))))
        {
          besideEdge = std::max(besideEdge, std::abs(samples.nu[at]));
          steepest = std::max(steepest, samples.slopeAt(i, j, k));
        }
      }
    }
  }
  hasEdge = hasEdge || (hasGas ? hasWall || hasWindow : hasWall && hasWindow);
  if (!hasEdge)
  {
    brick.kind = hasGas ? Leaf<Real>::Samples : hasWall ? Leaf<Real>::Solid : Leaf<Real>::Constant;
    return false;
  }
  BrickFacts& facts = brick.facts;
  facts.hasWallEdge = hasWall || (content.hasWall && !hasWindow);
  facts.areWallsFlat = content.areWallsFlat;
  facts.besideWindow = hasWindow || !hasWall ? deflectionByRange * besideEdge : 0;
  const std::array<double, 3> voxel = voxelOf(place.level);
  // Light that crosses the edge at another place misses so much of what bends it, or has it twice.
  constexpr double shiftByBend = 2, leastShift = 0.05; // voxels
  const double shift = std::min(1., shiftByBend * static_cast<double>(bend) + leastShift);
  facts.ofWindow = facts.besideWindow > 0 ? shift * steepest : 0;
  facts.normals = bend > 0 ? normals : facts.normals;
  facts.edgeError =
    static_cast<double>(bend) * *std::max_element(voxel.begin(), voxel.begin() + axes());
  facts.areEdgesFine = areEdgesFine(place.level, content);
  brick.kind = Leaf<Real>::Mixed;
  storeGasDistances(samples, brick);
  return true;
}

template <class Real>
void BrickMaker<Real>::storeGasDistances(const BrickSamples& samples, Brick<Real>& brick) const
{
  const bool isLayer = shape_ == BrickShape::Layer;
  const int stored = edge + 2 * apron_;
  const int skipped = samples.margin - apron_;
  brick.gasDistances.reserve(static_cast<std::size_t>(samplesPerBrick()));
  const bool hasWindow =
    std::find(samples.places.begin(), samples.places.end(), Place::Window) != samples.places.end();
  constexpr auto reach = static_cast<double>(MediumSource::reach);
  for (int k = 0; k < layersOf(stored); ++k)
  {
    for (int j = 0; j < stored; ++j)
    {
      for (int i = 0; i < stored; ++i)
      {
        // Where gas ends with the domain there is no edge: rounding would decide where rays that end there are.
        const std::array<int, 3> nearest =
          samples.nearestWithin({ i + skipped, j + skipped, isLayer ? 0 : k + skipped });
        const double units =
          std::clamp(static_cast<double>(samples.distanceForLinear(nearest)), -reach, reach) *
          distanceUnits / 2;
        const int even = 2 * static_cast<int>(units + (units < 0 ? -0.5 : 0.5));
        const bool isWindow = hasWindow && endsAtWindow(samples, nearest);
        brick.gasDistances.push_back(static_cast<std::int16_t>(even + (isWindow ? 1 : 0)));
      }
    }
  }
}

template bool BrickMaker<float>::findEdges(
  const NodePlace&, const MediumSource::Content&, BrickSamples&, Brick<float>&) const;
template bool BrickMaker<double>::findEdges(
  const NodePlace&, const MediumSource::Content&, BrickSamples&, Brick<double>&) const;

} // namespace schlieren
