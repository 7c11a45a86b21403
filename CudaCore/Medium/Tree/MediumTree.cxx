// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The nodes of a tree, and what rays see of them.
#include "Medium/Tree/MediumTree.h"

#include "Medium/Samples/Field.h"
#include "Medium/Samples/Prefilter.h"
#include "Medium/Tree/NodesInView.h"
#include "Medium/Tree/RootCells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace schlieren
{

namespace
{

MediumSource::Content contentOfAll(const MediumSource& source, double ambient)
{
  validateAmbient(ambient);
  const MediumSource::Content content = source.contentOf(source.bounds());
  if (!content.hasGas)
  {
    validateRange(1, 0);
  }
  validateRange(content.lowest, content.highest);
  return content;
}

double largestNuOf(const MediumSource::Content& content, double ambient)
{
  return std::max(std::abs(content.lowest - ambient), std::abs(content.highest - ambient)) /
    (1 + ambient);
}

} // namespace

template <class Real>
MediumTree<Real>::MediumTree(
  std::shared_ptr<const MediumSource> source, double ambient, const TreeSettings& settings)
  : source_(std::move(source))
  , settings_(settings)
  , grid_(gridOf(*source_))
  , coarserLevels_(divisionOf(*source_).coarserLevels)
  , rootCells_(rootCellsOf(divisionOf(*source_)))
  , maker_(*source_,
      { grid_, ambient, largestNuOf(contentOfAll(*source_, ambient), ambient),
        settings.interpolation })
  , samples_({ static_cast<std::size_t>(maker_.samplesPerBrick()), 1,
      PaddedVolume<Real>::readTogether, settings.memory })
  , maps_({ static_cast<std::size_t>(maker_.samplesPerBrick()) })
{
  static_assert(brickEdge == BrickMaker<Real>::edge);
  const MediumSource::Content content = contentOfAll(*source_, ambient);
  largestN_ = std::max(std::abs(content.lowest), std::abs(content.highest));
  rangeOfNu_ = (content.highest - content.lowest) / (1 + ambient);
  makeRoots();
  arrange();
}

template <class Real>
void MediumTree<Real>::makeRoots()
{
  nodes_.clear();
  for (std::int32_t k = 0; k < rootCells_[2]; ++k)
  {
    for (std::int32_t j = 0; j < rootCells_[1]; ++j)
    {
      for (std::int32_t i = 0; i < rootCells_[0]; ++i)
      {
        addNode({ -coarserLevels_, { i, j, k } });
      }
    }
  }
  samples_.clear();
  maps_.clear();
  isMeasured_ = false;
}

template <class Real>
void MediumTree<Real>::addNode(const NodePlace& place)
{
  nodes_.push_back({ place });
}

template <class Real>
LeafFinder MediumTree<Real>::finder() const
{
  const double perIndex = std::ldexp(1. / brickEdge, -coarserLevels_);
  return { roots_.data(), children_.data(), { rootCells_[0], rootCells_[1], rootCells_[2] },
    { perIndex, perIndex, shape() == BrickShape::Layer ? 0 : perIndex } };
}

template <class Real>
std::size_t MediumTree<Real>::bytesUsed() const
{
  return samples_.bytesUsed() + maps_.bytesUsed() + nodes_.size() * sizeof(Node) +
    leaves_.size() * (sizeof(Leaf<Real>) + 2 * sizeof(std::int32_t));
}

template <class Real>
BrickLayout MediumTree<Real>::layout() const
{
  return { samplesPerBrick(), apron(), shape(), settings_.interpolation };
}

template <class Real>
Leaf<Real> MediumTree<Real>::leafOf(std::int32_t at) const
{
  const Node& node = nodes_[static_cast<std::size_t>(at)];
  Leaf<Real> leaf{ {}, std::ldexp(1., node.place.level), node.offset, node.brick, node.map,
    node.kind };
  for (std::size_t axis = 0; axis < maker_.axes(); ++axis)
  {
    leaf.first[axis] =
      std::ldexp(brickEdge * static_cast<double>(node.place.at[axis]) + 0.5, -node.place.level);
  }
  return leaf;
}

/// Leaves, roots and children as rays see them, depth first: neighbours in space are near each other.
template <class Real>
void MediumTree<Real>::numberLeaves()
{
  leafNodes_.clear();
  children_.clear();
  roots_.resize(static_cast<std::size_t>(rootCells_[0]) *
    static_cast<std::size_t>(rootCells_[1] * rootCells_[2]));
  for (std::size_t root = 0; root < roots_.size(); ++root)
  {
    number(static_cast<std::int32_t>(root), roots_[root]);
  }
  // Of a tree that has not changed they stay where they are: rays have their addresses.
  leaves_.resize(leafNodes_.size());
  std::transform(leafNodes_.begin(), leafNodes_.end(), leaves_.begin(),
    [this](std::int32_t at) { return leafOf(at); });
}

template <class Real>
void MediumTree<Real>::number(std::int32_t at, std::int32_t& code)
{
  const Node& node = nodes_[static_cast<std::size_t>(at)];
  if (node.children < 0)
  {
    code = ~static_cast<std::int32_t>(leafNodes_.size());
    leafNodes_.push_back(at);
    return;
  }
  const std::size_t first = children_.size();
  code = static_cast<std::int32_t>(first / 8);
  children_.resize(first + 8, -1); // where nothing depends on z, rays take the lower four
  for (std::int32_t child = 0; child < childCount(); ++child)
  {
    std::int32_t ofChild = 0;
    number(node.children + child, ofChild);
    children_[first + static_cast<std::size_t>(child)] = ofChild;
  }
}

/// Nodes and bricks in the order of leaves, without gaps.
template <class Real>
void MediumTree<Real>::arrange()
{
  const auto roots = std::ptrdiff_t{ rootCells_[0] } * rootCells_[1] * rootCells_[2];
  std::vector<Node> arranged(nodes_.begin(), nodes_.begin() + roots);
  for (std::size_t n = 0; n < arranged.size(); ++n)
  {
    if (const std::int32_t children = arranged[n].children; children >= 0)
    {
      arranged[n].children = static_cast<std::int32_t>(arranged.size());
      for (std::int32_t child = 0; child < childCount(); ++child)
      {
        arranged.push_back(nodes_[static_cast<std::size_t>(children + child)]);
      }
    }
  }
  nodes_ = std::move(arranged);
  numberLeaves();

  std::vector<std::int32_t> bricks{ 0 };
  std::vector<std::int32_t> maps;
  for (const std::int32_t at : leafNodes_)
  {
    Node& node = nodes_[static_cast<std::size_t>(at)];
    if (node.brick > 0)
    {
      bricks.push_back(node.brick);
      node.brick = static_cast<std::int32_t>(bricks.size()) - 1;
    }
    if (node.map >= 0)
    {
      maps.push_back(node.map);
      node.map = static_cast<std::int32_t>(maps.size()) - 1;
    }
  }
  samples_.arrange(bricks);
  maps_.arrange(maps);
  isArranged_ = true;
  numberLeaves();
}

template <class Real>
void MediumTree<Real>::summarize()
{
  statistics_ = {};
  statistics_.coarsestLevel = View::finestLevelOfAll;
  largestNu_ = 0;
  slope_ = { 0, 0, 0 };
  steepest_ = {};
  statistics_.smallestVoxel = std::numeric_limits<double>::infinity();
  for (const std::int32_t at : leafNodes_)
  {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    const int level = node.place.level;
    const BrickFacts& facts = node.facts;
    largestNu_ = std::max(largestNu_, facts.largestNu);
    slope_.x = std::max(slope_.x, std::ldexp(facts.slope[0], level));
    slope_.y = std::max(slope_.y, std::ldexp(facts.slope[1], level));
    slope_.z = std::max(slope_.z, std::ldexp(facts.slope[2], level));
    steepest_.include(
      { length(Vec3<double>{ facts.slope[0], facts.slope[1], facts.slope[2] }), facts.steepestAt });
    if (node.brick > 0)
    {
      ++statistics_.bricks;
      statistics_.coarsestLevel = std::min(statistics_.coarsestLevel, level);
      statistics_.finestLevel = std::max(statistics_.finestLevel, level);
    }
    statistics_.constantLeaves += node.kind == Leaf<Real>::Constant ? 1 : 0;
  }
  statistics_.coarsestLevel = std::min(statistics_.coarsestLevel, statistics_.finestLevel);
  const std::array<double, 3> voxel = maker_.voxelOf(statistics_.finestLevel);
  statistics_.smallestVoxel = *std::min_element(voxel.begin(), voxel.begin() + maker_.axes());
  statistics_.voxels =
    statistics_.bricks * brickEdge * brickEdge * (shape() == BrickShape::Layer ? 1 : brickEdge);
  statistics_.bytes = static_cast<std::int64_t>(bytesUsed());
  statistics_.isMemoryShort = work_.isMemoryShort;
  statistics_.largestDeflection = work_.largest;
  statistics_.deflectionError = work_.error;
}

template class MediumTree<float>;
template class MediumTree<double>;

} // namespace schlieren
