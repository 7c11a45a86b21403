// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the nodes of a tree have: bricks that are kept, here or by the process that owns them, and forgotten.
#include "Medium/NodesInView.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace schlieren
{

template <class Real>
std::int32_t MediumTree<Real>::Numbers::take()
{
  if (free.empty())
  {
    return next++;
  }
  const std::int32_t number = free.back();
  free.pop_back();
  return number;
}

/// Gives other processes what is theirs.
template <class Real>
void MediumTree<Real>::sendBricks()
{
  for (std::size_t owner = 1; owner < owned_.size(); ++owner)
  {
    DeliveredBricks<Real>& unsent = owned_[owner].unsent;
    if (unsent.count() > 0)
    {
      sendBricks(static_cast<std::int32_t>(owner));
    }
  }
}

template <class Real>
void MediumTree<Real>::sendBricks(std::int32_t owner)
{
  DeliveredBricks<Real>& unsent = owned_[static_cast<std::size_t>(owner)].unsent;
  settings_.owners->put(owner, unsent.toBytes());
  unsent = {};
}

template <class Real>
void MediumTree<Real>::keep(std::int32_t at, const Brick<Real>& brick, std::int32_t owner)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  node.isKnown = true;
  node.kind = brick.kind;
  node.offset = brick.offset;
  node.facts = brick.facts;
  const std::vector<float>& gradients = brick.fields.gradients;
  const bool hasAny = !brick.samples.empty() || !brick.gasDistances.empty() || !gradients.empty();
  node.owner = static_cast<std::int16_t>(hasAny ? owner : 0);
  std::int32_t ofGradients = 0;
  if (node.owner == 0)
  {
    node.brick = brick.samples.empty() ? 0 : samples_.add(brick.samples);
    node.map = brick.gasDistances.empty() ? -1 : maps_.add(brick.gasDistances);
    ofGradients = gradients.empty() ? 0 : gradients_.add(gradients);
  }
  else
  {
    Owned& owned = owned_[static_cast<std::size_t>(owner)];
    const auto give = [](const auto& values, Numbers& numbers, auto& numbersSent, auto& sent)
    {
      numbersSent.push_back(numbers.take());
      sent.insert(sent.end(), values.begin(), values.end());
      return numbersSent.back();
    };
    DeliveredBricks<Real>& unsent = owned.unsent;
    node.brick = brick.samples.empty()
      ? 0
      : give(brick.samples, owned.samples, unsent.samplesNumbers, unsent.samples);
    node.map = brick.gasDistances.empty()
      ? -1
      : give(brick.gasDistances, owned.maps, unsent.mapNumbers, unsent.maps);
    ofGradients = gradients.empty()
      ? 0
      : give(gradients, owned.gradients, unsent.gradientNumbers, unsent.gradients);
    constexpr std::size_t most = 64; // its owner has memory for those that have come, too
    if (unsent.count() >= most)
    {
      sendBricks(owner);
    }
  }
  if (!nodeFields_.empty())
  {
    nodeFields_[static_cast<std::size_t>(at)] = { ofGradients, false, brick.fields.facts };
  }
}

/// Gives a brick's place back, where it is.
template <class Real>
template <class Store>
void MediumTree<Real>::release(
  std::int32_t brick, std::int16_t owner, Store& own, Numbers Owned::*ofOther)
{
  if (owner == 0)
  {
    own.remove(brick);
  }
  else
  {
    (owned_[static_cast<std::size_t>(owner)].*ofOther).free.push_back(brick);
  }
}

template <class Real>
void MediumTree<Real>::removeSamples(std::int32_t at)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  if (node.brick > 0)
  {
    release(node.brick, node.owner, samples_, &Owned::samples);
    node.brick = 0;
    findOwner(at);
  }
}

template <class Real>
void MediumTree<Real>::removeMap(std::int32_t at)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  if (node.map >= 0)
  {
    release(node.map, node.owner, maps_, &Owned::maps);
    node.map = -1;
    findOwner(at);
  }
}

template <class Real>
void MediumTree<Real>::removeGradients(std::int32_t at)
{
  if (const std::int32_t brick = fieldsOf(at).brick; brick > 0)
  {
    release(brick, nodes_[static_cast<std::size_t>(at)].owner, gradients_, &Owned::gradients);
    nodeFields_[static_cast<std::size_t>(at)].brick = 0;
    findOwner(at);
  }
}

/// Of a node that has lost something.
template <class Real>
void MediumTree<Real>::findOwner(std::int32_t at)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  const bool hasAny = node.brick > 0 || node.map >= 0 || fieldsOf(at).brick > 0;
  node.owner = hasAny ? node.owner : std::int16_t{ 0 };
}

/// Takes a node's samples from it.
template <class Real>
void MediumTree<Real>::forget(std::int32_t at)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  removeSamples(at);
  removeMap(at);
  removeGradients(at);
  if (!nodeFields_.empty())
  {
    nodeFields_[static_cast<std::size_t>(at)] = {};
  }
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
    const Negligible negligible = view.negligible(node.place.level);
    if (const NodeFields fields = fieldsOf(at);
        fields.brick > 0 && fields.facts.range <= negligible.gathered)
    {
      nodeFields_[static_cast<std::size_t>(at)].facts.neglected =
        std::max(fields.facts.neglected, fields.facts.range);
      removeGradients(at);
    }
    if (node.map >= 0 && !facts.hasWallEdge && facts.besideWindow <= negligible.deflection &&
      fieldsOf(at).brick == 0)
    {
      facts.neglected = std::max(facts.neglected, facts.besideWindow);
      removeMap(at);
      node.kind = Leaf<Real>::Samples;
    }
    if (node.brick > 0 && node.kind == Leaf<Real>::Samples && facts.range <= negligible.deflection)
    {
      facts.neglected = std::max(facts.neglected, facts.range);
      removeSamples(at);
      node.kind = Leaf<Real>::Constant;
    }
  }
}

template <class Real>
void MediumTree<Real>::forgetBelow(std::int32_t at)
{
  std::int32_t& children = nodes_[static_cast<std::size_t>(at)].children;
  for (std::int32_t child = 0; children >= 0 && child < parts(); ++child)
  {
    forgetBelow(children + child);
  }
  forget(at);
  children = -1;
}

/// Makes unknown what is outside of the view or finer than it needs.
template <class Real>
bool MediumTree<Real>::forgetUnneeded(const View& view)
{
  bool hasChanged = false;
  for (std::int32_t root = 0; root < rootCells_[0] * rootCells_[1] * rootCells_[2]; ++root)
  {
    hasChanged = forgetUnneeded(root, view) || hasChanged;
  }
  return hasChanged;
}

template <class Real>
bool MediumTree<Real>::isNeeded(const Node& node, const View& view) const
{
  return view.sees(node.place) && (node.children < 0 || view.allows(node.place));
}

template <class Real>
bool MediumTree<Real>::hasUnneeded(const View& view) const
{
  return std::any_of(nodes_.begin(), nodes_.end(),
    [&](const Node& node)
    { return (node.children >= 0 || node.isKnown) && !isNeeded(node, view); });
}

template <class Real>
bool MediumTree<Real>::forgetUnneeded(std::int32_t at, const View& view)
{
  Node& node = nodes_[static_cast<std::size_t>(at)];
  const bool isInner = node.children >= 0;
  if (!isNeeded(node, view))
  {
    const bool hasAny = isInner || node.isKnown;
    forgetBelow(at);
    return hasAny;
  }
  bool hasChanged = false;
  for (std::int32_t child = 0; isInner && child < parts(); ++child)
  {
    hasChanged = forgetUnneeded(node.children + child, view) || hasChanged;
  }
  return hasChanged;
}

template void MediumTree<float>::sendBricks();
template void MediumTree<float>::keep(std::int32_t, const Brick<float>&, std::int32_t);
template void MediumTree<float>::forget(std::int32_t);
template void MediumTree<float>::forgetNegligible(const View&);
template bool MediumTree<float>::forgetUnneeded(const View&);
template bool MediumTree<float>::hasUnneeded(const View&) const;
template void MediumTree<double>::sendBricks();
template void MediumTree<double>::keep(std::int32_t, const Brick<double>&, std::int32_t);
template void MediumTree<double>::forget(std::int32_t);
template void MediumTree<double>::forgetNegligible(const View&);
template bool MediumTree<double>::forgetUnneeded(const View&);
template bool MediumTree<double>::hasUnneeded(const View&) const;

} // namespace schlieren
