// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where bricks are requested of a source: children of one node together, whose lattices overlap.
#include "Medium/Tree/BrickCoefficients.h"
#include "Medium/Tree/BrickOutline.h"
#include "Medium/Tree/BrickSamples.h"

#include <algorithm>
#include <utility>

namespace schlieren
{

namespace
{

/// A source may keep what it knows of a lattice of so many points (LatticeCache).
constexpr std::int64_t mostPoints = 0xffff;

/// Whether two are children of one node; or of one layer of these.
bool areSiblings(const BrickRequest& a, const BrickRequest& b, bool isOfLayer)
{
  const auto isOfSame = [&](std::size_t axis)
  { return a.place.at[axis] >> 1 == b.place.at[axis] >> 1; };
  return a.isChild && b.isChild && a.place.level == b.place.level && isOfSame(0) && isOfSame(1) &&
    (isOfLayer ? a.place.at[2] == b.place.at[2] : isOfSame(2));
}

} // namespace

/// Points beyond a node: the apron's coefficients depend on the next ones. Beside edges values continue along lines of three.
template <class Real>
int BrickMaker<Real>::marginOf(bool hasEdges) const
{
  return apron_ + (hasEdges ? 3 : 1);
}

/// What is sampled: also what fronts may need.
template <class Real>
int BrickMaker<Real>::sampledMarginOf(bool hasEdges) const
{
  return std::max(marginOf(hasEdges), apron_ + supportOfFronts);
}

/// The lattice of so many nodes.
template <class Real>
Lattice BrickMaker<Real>::latticeOf(
  const NodePlace& first, const std::array<std::int32_t, 3>& nodes, bool hasEdges) const
{
  const int margin = sampledMarginOf(hasEdges);
  const auto pointsOf = [&](std::size_t axis) { return edge * nodes[axis] + 2 * margin; };
  Lattice lattice{ {}, voxelOf(first.level), { pointsOf(0), pointsOf(1), layersOf(pointsOf(2)) } };
  if (shape_ == BrickShape::Layer)
  {
    lattice.first[2] = 0.5 * (bounds_.low[2] + bounds_.high[2]);
    lattice.spacing[2] = std::max(lattice.spacing[0], lattice.spacing[1]);
  }
  for (std::size_t axis = 0; axis < axes(); ++axis)
  {
    const std::int64_t point = std::int64_t{ edge } * first.at[axis] - margin;
    lattice.first[axis] =
      rules_.grid.origin[axis] + (static_cast<double>(point) + 0.5) * lattice.spacing[axis];
  }
  return lattice;
}

template <class Real>
Lattice BrickMaker<Real>::latticeOf(const Sampled& sampled) const
{
  return latticeOf(sampled.first, sampled.nodes, sampled.hasEdges);
}

/// Children of one node are sampled together where these are fewer points.
template <class Real>
std::vector<typename BrickMaker<Real>::Sampled> BrickMaker<Real>::sampledOf(
  const std::vector<BrickRequest>& requests, const std::vector<Outline>& outlines) const
{
  const bool isOfLayer = latticeOf({ 0, {} }, { 2, 2, 2 }, true).size() > mostPoints;
  std::vector<Sampled> all;
  for (std::size_t begin = 0, end = 0; begin < requests.size(); begin = end)
  {
    std::vector<Sampled> alone;
    Sampled together{ requests[begin].place, { 1, 1, 1 }, false, {} };
    std::array<std::int32_t, 3> last{};
    std::int64_t points = 0;
    do
    {
      const Outline& outline = outlines[end];
      const NodePlace& place = requests[end].place;
      if (outline.isSampled)
      {
        const std::array<std::int32_t, 3> one{ 1, 1, 1 };
        alone.push_back({ place, one, outline.hasEdges, { end } });
        points += latticeOf(place, one, outline.hasEdges).size();
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const bool isFirst = alone.size() == 1;
          std::int32_t& low = together.first.at[axis];
          low = isFirst ? place.at[axis] : std::min(low, place.at[axis]);
          last[axis] = isFirst ? place.at[axis] : std::max(last[axis], place.at[axis]);
          together.nodes[axis] = last[axis] - low + 1;
        }
        together.hasEdges = together.hasEdges || outline.hasEdges;
        together.bricks.push_back(end);
      }
      ++end;
    } while (end < requests.size() && areSiblings(requests[begin], requests[end], isOfLayer));
    if (alone.size() > 1 && latticeOf(together).size() < points)
    {
      all.push_back(std::move(together));
    }
    else
    {
      std::move(alone.begin(), alone.end(), std::back_inserter(all));
    }
  }
  return all;
}

template <class Real>
typename BrickMaker<Real>::Values BrickMaker<Real>::valuesAt(const Sampled& sampled) const
{
  Values values;
  values.lattice = latticeOf(sampled);
  const auto points = static_cast<std::size_t>(values.lattice.size());
  values.nu.resize(points);
  values.places.resize(points);
  values.distances.resize(sampled.hasEdges ? points : 0);
  float* const distances = sampled.hasEdges ? values.distances.data() : nullptr;
  source_.sample(values.lattice, values.nu.data(), values.places.data(), distances);
  for (double& value : values.nu)
  {
    value = nuOf(value);
  }
  return values;
}

/// Those of one brick.
template <class Real>
BrickSamples BrickMaker<Real>::samplesOf(const Values& values, const Sampled& sampled,
  const NodePlace& place, const Outline& outline, int margin) const
{
  BrickSamples samples;
  samples.margin = margin;
  samples.n = edge + 2 * samples.margin;
  samples.layers = layersOf(samples.n);
  samples.begin[2] = 0;
  samples.end[2] = 1;
  std::array<std::size_t, 3> from{ 0, 0, 0 };
  const int skipped = sampledMarginOf(sampled.hasEdges) - margin;
  for (std::size_t axis = 0; axis < axes(); ++axis)
  {
    const std::int64_t first = std::int64_t{ edge } * place.at[axis] - samples.margin;
    const std::int64_t all = (rules_.grid.dimensions[axis] - 1) << place.level;
    samples.begin[axis] = static_cast<int>(std::max<std::int64_t>(0, -first));
    samples.end[axis] = static_cast<int>(std::min<std::int64_t>(samples.n, all - first));
    from[axis] =
      static_cast<std::size_t>(edge * (place.at[axis] - sampled.first.at[axis]) + skipped);
  }
  const auto cut = [&](const auto& all, auto& to)
  {
    const auto width = static_cast<std::size_t>(values.lattice.points[0]);
    const auto height = static_cast<std::size_t>(values.lattice.points[1]);
    const auto n = static_cast<std::size_t>(samples.n);
    const auto layers = static_cast<std::size_t>(samples.layers);
    to.reserve(n * n * layers);
    for (std::size_t k = from[2]; k < from[2] + layers; ++k)
    {
      for (std::size_t j = from[1]; j < from[1] + n; ++j)
      {
        const auto row =
          all.begin() + static_cast<std::ptrdiff_t>((k * height + j) * width + from[0]);
        to.insert(to.end(), row, row + samples.n);
      }
    }
  };
  cut(values.nu, samples.nu);
  cut(values.places, samples.places);
  if (outline.hasEdges)
  {
    cut(values.distances, samples.distances);
  }
  return samples;
}

template <class Real>
void BrickMaker<Real>::makeSampled(const Sampled& sampled,
  const std::vector<BrickRequest>& requests, std::vector<Outline>& outlines) const
{
  const Values values = valuesAt(sampled);
  for (const std::size_t n : sampled.bricks)
  {
    makeOf(requests[n], outlines[n],
      [&](int margin)
      { return samplesOf(values, sampled, requests[n].place, outlines[n], margin); });
  }
}

template <class Real>
std::vector<Brick<Real>> BrickMaker<Real>::make(const std::vector<BrickRequest>& requests) const
{
  std::vector<Outline> outlines;
  for (const BrickRequest& request : requests)
  {
    outlines.push_back(outlineOf(request));
  }
  for (const Sampled& sampled : sampledOf(requests, outlines))
  {
    makeSampled(sampled, requests, outlines);
  }
  std::vector<Brick<Real>> made;
  for (Outline& outline : outlines)
  {
    made.push_back(std::move(outline.brick));
  }
  return made;
}

template int BrickMaker<float>::marginOf(bool) const;
template int BrickMaker<float>::sampledMarginOf(bool) const;
template Lattice BrickMaker<float>::latticeOf(const Sampled&) const;
template std::vector<BrickMaker<float>::Sampled> BrickMaker<float>::sampledOf(
  const std::vector<BrickRequest>&, const std::vector<Outline>&) const;
template void BrickMaker<float>::makeSampled(
  const Sampled&, const std::vector<BrickRequest>&, std::vector<Outline>&) const;
template std::vector<Brick<float>> BrickMaker<float>::make(const std::vector<BrickRequest>&) const;
template int BrickMaker<double>::marginOf(bool) const;
template int BrickMaker<double>::sampledMarginOf(bool) const;
template Lattice BrickMaker<double>::latticeOf(const Sampled&) const;
template std::vector<BrickMaker<double>::Sampled> BrickMaker<double>::sampledOf(
  const std::vector<BrickRequest>&, const std::vector<Outline>&) const;
template void BrickMaker<double>::makeSampled(
  const Sampled&, const std::vector<BrickRequest>&, std::vector<Outline>&) const;
template std::vector<Brick<double>> BrickMaker<double>::make(
  const std::vector<BrickRequest>&) const;

} // namespace schlieren
