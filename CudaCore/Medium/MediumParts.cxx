// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/MediumParts.h"

#include "Medium/Prefilter.h"

#include <algorithm>

namespace schlieren
{

namespace
{

/// Appends a brick and returns its number.
template <class Value>
std::int32_t append(
  const std::vector<Value>& from, std::int32_t brick, std::int64_t perBrick, std::vector<Value>& to)
{
  const auto number = static_cast<std::int32_t>(static_cast<std::int64_t>(to.size()) / perBrick);
  const auto first = from.begin() + static_cast<std::ptrdiff_t>(brick * perBrick);
  to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(perBrick));
  return number;
}

} // namespace

template <class Real>
MediumParts<Real>::MediumParts(const MediumTree<Real>& tree, std::int32_t count)
  : tree_(tree)
  , count_(count)
{
  const std::size_t leaves = tree.leaves().size();
  const std::size_t perSample = static_cast<std::size_t>(tree.samplesPerBrick());
  const std::size_t ofGradients =
    perSample * static_cast<std::size_t>(tree.gradients().count) * sizeof(float);
  std::vector<std::size_t> bytes(leaves, 0);
  std::size_t all = 0;
  for (std::size_t n = 0; n < leaves; ++n)
  {
    const Leaf<Real>& leaf = tree.leaves()[n];
    bytes[n] = (leaf.brick > 0 ? perSample * sizeof(Real) : 0) +
      (leaf.map >= 0 ? perSample * sizeof(std::int16_t) : 0) +
      (!tree.gradientBricks().empty() && tree.gradientBricks()[n] > 0 ? ofGradients : 0);
    all += bytes[n];
  }
  owners_.assign(leaves, everywhere);
  std::size_t before = 0;
  for (std::size_t n = 0; n < leaves; ++n)
  {
    if (bytes[n] > 0)
    {
      const double middle = (static_cast<double>(before) + 0.5 * static_cast<double>(bytes[n])) /
        static_cast<double>(all);
      owners_[n] = std::min(static_cast<std::int32_t>(middle * count), count - 1);
      before += bytes[n];
    }
  }
}

template <class Real>
std::vector<Leaf<Real>> MediumParts<Real>::leavesInTree(std::int32_t owner) const
{
  std::vector<Leaf<Real>> leaves = tree_.leaves();
  for (std::size_t n = 0; n < leaves.size(); ++n)
  {
    if (owners_[n] != everywhere && owners_[n] != owner)
    {
      leaves[n].brick = ~owners_[n];
      leaves[n].map = -1;
    }
  }
  return leaves;
}

template <class Real>
typename MediumParts<Real>::Part MediumParts<Real>::part(std::int32_t owner) const
{
  const std::int64_t perBrick = tree_.samplesPerBrick();
  const std::int64_t ofGradients = perBrick * tree_.gradients().count;
  const std::vector<std::int32_t>& gradientBricks = tree_.gradientBricks();
  Part part;
  part.leaves = leavesInTree(owner);
  append(tree_.samples(), 0, perBrick, part.samples);
  if (ofGradients > 0)
  {
    append(tree_.gradientValues(), 0, ofGradients, part.gradients);
  }
  part.gradientBricks.assign(gradientBricks.size(), 0);
  for (std::size_t n = 0; n < part.leaves.size(); ++n)
  {
    Leaf<Real>& leaf = part.leaves[n];
    if (owners_[n] != owner)
    {
      continue;
    }
    if (leaf.brick > 0)
    {
      leaf.brick = append(tree_.samples(), leaf.brick, perBrick, part.samples);
    }
    if (leaf.map >= 0)
    {
      leaf.map = append(tree_.gasDistances(), leaf.map, perBrick, part.gasDistances);
    }
    if (!gradientBricks.empty() && gradientBricks[n] > 0)
    {
      part.gradientBricks[n] =
        append(tree_.gradientValues(), gradientBricks[n], ofGradients, part.gradients);
    }
  }
  part.samples.resize(part.samples.size() + PaddedVolume<Real>::readTogether, Real(0));
  return part;
}

template class MediumParts<float>;
template class MediumParts<double>;

} // namespace schlieren
