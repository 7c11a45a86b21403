// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/Tree/Brick.h"

#include "Medium/Tree/BrickCoefficients.h"
#include "Medium/Tree/BrickErrors.h"
#include "Medium/Tree/BrickOutline.h"
#include "Medium/Tree/BrickSamples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace schlieren
{

namespace
{

/// What coefficients may be beyond samples anyway, of the range of all.
constexpr double overshootByRange = 1e-3;

} // namespace

template <class Real>
BrickMaker<Real>::BrickMaker(const MediumSource& source, const BrickRules& rules)
  : source_(source)
  , rules_(rules)
  , bounds_(source.bounds())
  , smallest_(1e-20 * rules.largestNu)
  , shape_(source.isFlat() ? BrickShape::Layer : BrickShape::Cube)
  , apron_(rules.interpolation == Interpolation::Cubic ? 2 : 1)
{
  rules_.bytesOfReal = sizeof(Real);
  const MediumSource::Content content = source.contentOf(bounds_);
  overshoot_ = content.lowest <= content.highest
    ? overshootByRange * (nuOf(content.highest) - nuOf(content.lowest))
    : 0;
}

template <class Real>
std::int64_t BrickMaker<Real>::samplesPerBrick() const
{
  const int n = edge + 2 * apron_;
  return std::int64_t{ n } * n * layersOf(n);
}

template <class Real>
std::array<double, 3> BrickMaker<Real>::voxelOf(int level) const
{
  return { std::ldexp(rules_.grid.spacing[0], -level), std::ldexp(rules_.grid.spacing[1], -level),
    std::ldexp(rules_.grid.spacing[2], shape_ == BrickShape::Layer ? 0 : -level) };
}

template <class Real>
Box BrickMaker<Real>::boxOf(const NodePlace& place) const
{
  const std::array<double, 3> voxel = voxelOf(place.level);
  Box box = bounds_;
  for (std::size_t axis = 0; axis < axes(); ++axis)
  {
    box.low[axis] = rules_.grid.origin[axis] + edge * voxel[axis] * place.at[axis];
    box.high[axis] = rules_.grid.origin[axis] + edge * voxel[axis] * (place.at[axis] + 1);
  }
  return box;
}

template <class Real>
Box BrickMaker<Real>::boxWithApron(const NodePlace& place) const
{
  Box box = boxOf(place);
  const std::array<double, 3> voxel = voxelOf(place.level);
  for (std::size_t axis = 0; axis < axes(); ++axis)
  {
    box.low[axis] = std::max(box.low[axis] - apron_ * voxel[axis], bounds_.low[axis]);
    box.high[axis] = std::min(box.high[axis] + apron_ * voxel[axis], bounds_.high[axis]);
  }
  return box;
}

/// Relative to the brick's offset.
template <class Real>
void BrickMaker<Real>::storeCoefficients(const BrickSamples& samples, Brick<Real>& brick) const
{
  const int stored = edge + 2 * apron_;
  const int skipped = samples.margin - apron_;
  brick.samples.resize(static_cast<std::size_t>(samplesPerBrick()));
  Real* to = brick.samples.data();
  for (int k = 0; k < layersOf(stored); ++k)
  {
    for (int j = 0; j < stored; ++j)
    {
      const double* row = samples.nu.data() +
        samples.index(skipped, j + skipped, shape_ == BrickShape::Layer ? 0 : k + skipped);
      for (int i = 0; i < stored; ++i)
      {
        const double relative = row[i] - static_cast<double>(brick.offset);
        *to++ = static_cast<Real>(std::abs(relative) < smallest_ ? 0 : relative);
      }
    }
  }
}

template <class Real>
void BrickMaker<Real>::findBounds(const NodePlace& place, Brick<Real>& brick) const
{
  const int stored = edge + 2 * apron_;
  const std::array<int, 3> strides{ 1, stored, stored * stored };
  const std::array<double, 3> voxel = voxelOf(place.level);
  BrickFacts& facts = brick.facts;
  const auto [lowest, highest] = std::minmax_element(brick.samples.begin(), brick.samples.end());
  const auto offset = static_cast<double>(brick.offset);
  facts.largestNu = std::max(std::abs(offset + static_cast<double>(*lowest)),
    std::abs(offset + static_cast<double>(*highest)));
  for (std::size_t axis = 0; axis < axes(); ++axis)
  {
    std::array<int, 3> to{ stored, stored, layersOf(stored) };
    to[axis] -= 1;
    const auto rowAt = [&](int j, int k)
    { return brick.samples.data() + k * strides[2] + j * strides[1]; };
    const std::ptrdiff_t toNext = strides[axis];
    Real largest = 0;
    int steepestPlane = 0;
    for (int k = 0; k < to[2]; ++k)
    {
      std::array<Real, edge + 4> most{};
      for (int j = 0; j < to[1]; ++j)
      {
        const Real* row = rowAt(j, k);
        for (int i = 0; i < to[0]; ++i)
        {
          const Real difference = std::abs(row[i + toNext] - row[i]);
          most[static_cast<std::size_t>(i)] = most[static_cast<std::size_t>(i)] < difference
            ? difference
            : most[static_cast<std::size_t>(i)];
        }
      }
      const Real ofPlane = *std::max_element(most.begin(), most.end());
      steepestPlane = ofPlane > largest ? k : steepestPlane;
      largest = ofPlane > largest ? ofPlane : largest;
    }
    facts.slope[axis] = static_cast<double>(largest);
    if (facts.slope[axis] / voxel[axis] <= facts.steepest)
    {
      continue;
    }
    facts.steepest = facts.slope[axis] / voxel[axis];
    std::array<int, 3> at{ 0, 0, steepestPlane };
    while (std::abs(rowAt(at[1], at[2])[at[0] + toNext] - rowAt(at[1], at[2])[at[0]]) < largest)
    {
      at[1] += at[0] + 1 == to[0] ? 1 : 0;
      at[0] = at[0] + 1 == to[0] ? 0 : at[0] + 1;
    }
    facts.steepestAt[2] = 0.5 * static_cast<double>(rules_.grid.dimensions[2] - 1);
    for (std::size_t other = 0; other < axes(); ++other)
    {
      const double local =
        std::clamp(at[other] - apron_ + (other == axis ? 0.5 : 0), -0.49, edge - 0.51);
      facts.steepestAt[other] =
        std::ldexp(edge * static_cast<double>(place.at[other]) + 0.5 + local, -place.level);
    }
  }
}

/// `samplesWith`: those of its lattice that are at most so far beyond the node.
template <class Real>
void BrickMaker<Real>::makeOf(const BrickRequest& request, Outline& outline,
  const std::function<BrickSamples(int margin)>& samplesWith) const
{
  const NodePlace& place = request.place;
  const MediumSource::Content& content = outline.content;
  Brick<Real>& brick = outline.brick;
  BrickSamples samples = samplesWith(marginOf(outline.hasEdges));
  samples.fill();
  brick.kind = Leaf<Real>::Samples;
  const bool hasEdge = outline.hasEdges && findEdges(place, content, samples, brick);
  BrickFacts& facts = brick.facts;
  if (hasEdge && !facts.hasWallEdge && facts.besideWindow == 0)
  {
    // The cells know of gas that no sample has met, or only those around: without its map, all of the
    // node would be gas.
    facts.besideWindow =
      deflectionByRange * std::max(std::abs(outline.lowest), std::abs(outline.highest));
    facts.ofWindow = samples.hasGas() ? 0 : facts.besideWindow;
  }
  if (!samples.hasGas())
  {
    brick.kind = brick.kind == Leaf<Real>::Samples ? Leaf<Real>::Constant : brick.kind;
    return;
  }
  findErrors(place, content, samples, hasEdge && !samples.isGas.empty(), facts);
  facts.difference = samples.highest - samples.lowest;
  facts.range = deflectionByRange * facts.difference;
  const bool isGas = brick.kind == Leaf<Real>::Samples || brick.kind == Leaf<Real>::Mixed;
  if (facts.range <= request.negligible)
  {
    facts.neglected = std::max(facts.neglected, facts.range);
    facts.largestNu = std::max(std::abs(samples.lowest), std::abs(samples.highest));
    brick.offset = isGas ? static_cast<Real>(0.5 * (samples.lowest + samples.highest)) : Real(0);
    brick.kind = brick.kind == Leaf<Real>::Samples ? Leaf<Real>::Constant : brick.kind;
    return;
  }
  if (isGas)
  {
    brick.offset = static_cast<Real>(0.5 * (samples.lowest + samples.highest));
    const CoefficientRule rule{ rules_.interpolation == Interpolation::Cubic ? 1. / 6 : 1. / 8,
      apron_, axes(), overshoot_ };
    if (!makeCoefficients(samples, rule))
    {
      samples = samplesWith(sampledMarginOf(outline.hasEdges));
      samples.fill();
      makeCoefficients(samples, rule);
    }
    storeCoefficients(samples, brick);
    findBounds(place, brick);
  }
  else
  {
    facts.difference = 0; // of gas beside it
  }
}

template class BrickMaker<float>;
template class BrickMaker<double>;

} // namespace schlieren
