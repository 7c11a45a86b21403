// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What finer samples of a brick would lessen.
#include "Medium/Tree/BrickErrors.h"

#include "Medium/Tree/Brick.h"
#include "Medium/Tree/BrickSamples.h"

#include <cstddef>

namespace schlieren
{

namespace
{

/// The gradient of a quadratic spline through samples is wrong by about a twelfth of their third difference, a
/// voxel.
constexpr double errorByThirdDifference = 1. / 12;

/// Beside an edge, beyond which values continue as lines, third differences are second ones of the gas, by half of which
/// gradients are wrong.
constexpr float byEdge = 6;

/// Errors of gradients in a brick along an axis, nu by voxel; 0 where there is no gas.
std::vector<float> gradientErrors(const BrickSamples& samples, std::size_t axis, GradientsOf which)
{
  constexpr int edge = BrickMaker<float>::edge;
  const int layers = samples.layers > 1 ? edge : 1;
  const int first = samples.margin, firstLayer = layers > 1 ? samples.margin : 0;
  const std::array<std::ptrdiff_t, 3> strides{ 1, samples.n,
    std::ptrdiff_t{ samples.n } * samples.n };
  const std::ptrdiff_t s = strides[axis];
  const bool isOfGas = which == GradientsOf::Gas;
  std::vector<float> thirds(static_cast<std::size_t>(edge * edge * layers));
  float* to = thirds.data();
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < edge; ++j, to += edge)
    {
      const std::size_t row = samples.index(first, first + j, firstLayer + k);
      const double* p = samples.nu.data() + row;
      for (int i = 0; i < edge; ++i)
      {
        to[i] = static_cast<float>(
          errorByThirdDifference * (p[i + 2 * s] - p[i - s] - 3 * (p[i + s] - p[i])));
      }
      if (!samples.isGas.empty())
      {
        const unsigned char* is = samples.isGas.data() + row;
        for (int i = 0; i < edge; ++i)
        {
          const bool areAllGas = (is[i - s] & is[i] & is[i + s] & is[i + 2 * s]) != 0;
          const bool isBeside = (is[i] & is[i + s]) != 0;
          to[i] *= isOfGas ? (areAllGas ? 1.f : 0.f) : isBeside && !areAllGas ? byEdge : 0.f;
        }
      }
    }
  }
  return thirds;
}

} // namespace

/// The errors that finer samples would lessen.
template <class Real>
void BrickMaker<Real>::findErrors(const NodePlace& place, const MediumSource::Content& content,
  const BrickSamples& samples, bool hasEdge, BrickFacts& facts) const
{
  const std::array<double, 3> voxel = voxelOf(place.level);
  for (std::size_t axis = 0; axis < axes(); ++axis)
  {
    const bool inGas = voxel[axis] > voxelByCell * content.cellSize[axis];
    const bool atEdges = hasEdge && voxel[axis] > edgeVoxelByCell * content.cellSize[axis];
    facts.canImprove[axis] = inGas;
    facts.canImproveAtEdges[axis] = atEdges;
    const auto add = [&](GradientsOf which)
    { addLines(gradientErrors(samples, axis, which), axis, shape_, voxel, which, facts.errors); };
    if (inGas)
    {
      add(GradientsOf::Gas);
    }
    if (atEdges)
    {
      add(GradientsOf::Edges);
    }
  }
  const double missed = std::max(0., nuOf(content.highest) - samples.highest) +
    std::max(0., samples.lowest - nuOf(content.lowest));
  for (std::size_t axis = 0; axis < axes(); ++axis)
  {
    if (voxel[axis] > coarseByCell * content.cellSize[axis] &&
      missed > missedByRange * (samples.highest - samples.lowest))
    {
      facts.hidden[axis] = deflectionByRange * missed;
    }
  }
}

template void BrickMaker<float>::findErrors(
  const NodePlace&, const MediumSource::Content&, const BrickSamples&, bool, BrickFacts&) const;
template void BrickMaker<double>::findErrors(
  const NodePlace&, const MediumSource::Content&, const BrickSamples&, bool, BrickFacts&) const;

} // namespace schlieren
