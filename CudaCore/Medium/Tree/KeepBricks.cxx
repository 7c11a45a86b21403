// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the nodes of a tree have: bricks that are kept and forgotten.
#include "Medium/Tree/NodesInView.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace schlieren
{

template <class Real>
void MediumTree<Real>::keep(std::int32_t at, const Brick<Real>& brick)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  node.isKnown = true;
  node.kind = brick.kind;
  node.offset = brick.offset;
  node.facts = brick.facts;
  node.brick = brick.samples.empty() ? 0 : samples_.add(brick.samples);
  node.map = brick.gasDistances.empty() ? -1 : maps_.add(brick.gasDistances);
}

template <class Real>
void MediumTree<Real>::removeSamples(std::int32_t at)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  if (node.brick > 0)
  {
    samples_.remove(node.brick);
    node.brick = 0;
  }
}

template <class Real>
void MediumTree<Real>::removeMap(std::int32_t at)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  if (node.map >= 0)
  {
    maps_.remove(node.map);
    node.map = -1;
  }
}

/// Takes a node's samples from it.
template <class Real>
void MediumTree<Real>::forget(std::int32_t at)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  removeSamples(at);
  removeMap(at);
  const NodePlace place = node.place;
  const std::int32_t children = node.children;
  node = { place, children };
}

/// Nothing is negligible to those nodes that are made first: what is, now that more is known, goes.
template <class Real>
void MediumTree<Real>::forgetNegligible(const View& view)
{
  for (const std::int32_t at : leafNodes_)
  {
    Node& node = nodes_[static_cast<std::size_t>(at)];
    BrickFacts& facts = node.facts;
    const double negligible = view.negligible(node.place.level);
    if (node.map >= 0 && !facts.hasWallEdge && facts.besideWindow <= negligible)
    {
      facts.neglected = std::max(facts.neglected, facts.besideWindow);
      removeMap(at);
      node.kind = Leaf<Real>::Samples;
    }
    if (node.brick > 0 && node.kind == Leaf<Real>::Samples && facts.range <= negligible)
    {
      facts.neglected = std::max(facts.neglected, facts.range);
      removeSamples(at);
      node.kind = Leaf<Real>::Constant;
    }
  }
}

template void MediumTree<float>::keep(std::int32_t, const Brick<float>&);
template void MediumTree<float>::forget(std::int32_t);
template void MediumTree<float>::forgetNegligible(const View&);
template void MediumTree<double>::keep(std::int32_t, const Brick<double>&);
template void MediumTree<double>::forget(std::int32_t);
template void MediumTree<double>::forgetNegligible(const View&);

} // namespace schlieren
