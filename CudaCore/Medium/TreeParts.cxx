// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Medium/TreeParts.h"

#include <functional>

namespace schlieren
{

template <class Real>
TreeParts divideTree(const MediumView<Real>& medium, std::size_t leaves, const Vec3<double>& along,
  std::size_t bytesOfPart)
{
  TreeParts parts;
  parts.ofLeaf.assign(leaves, TreeParts::none);
  const auto perBrick = static_cast<std::size_t>(medium.brickStride);
  std::size_t bytes = 0;
  const auto add = [&](std::int32_t number)
  {
    const Leaf<Real>& leaf = medium.leaves[number];
    const std::size_t ofLeaf = (leaf.brick != 0 ? perBrick * sizeof(Real) : 0) +
      (leaf.map >= 0 ? perBrick * sizeof(std::int16_t) : 0);
    if (ofLeaf == 0)
    {
      return;
    }
    if (parts.ends.empty() || bytes + ofLeaf > bytesOfPart)
    {
      parts.ends.push_back(parts.leaves.size());
      bytes = 0;
    }
    bytes += ofLeaf;
    parts.ofLeaf[static_cast<std::size_t>(number)] = parts.count() - 1;
    parts.leaves.push_back(number);
    parts.ends.back() = parts.leaves.size();
  };

  const bool isReversed[3] = { along.x < 0, along.y < 0, along.z < 0 };
  const bool isLayer = medium.planeStride == 0; // whose children are the lower four
  const int children = isLayer ? 4 : 8;
  const int first =
    (isReversed[0] ? 1 : 0) | (isReversed[1] ? 2 : 0) | (isReversed[2] && !isLayer ? 4 : 0);
  const std::function<void(std::int32_t)> visit = [&](std::int32_t node)
  {
    if (node < 0)
    {
      add(~node);
      return;
    }
    for (int child = 0; child < children; ++child)
    {
      visit(medium.finder.children[8 * std::int64_t{ node } + (child ^ first)]);
    }
  };
  const std::int32_t* const cells = medium.finder.rootCells;
  const auto ordered = [&](std::int32_t n, int axis)
  { return isReversed[axis] ? cells[axis] - 1 - n : n; };
  for (std::int32_t k = 0; k < cells[2]; ++k)
  {
    for (std::int32_t j = 0; j < cells[1]; ++j)
    {
      for (std::int32_t i = 0; i < cells[0]; ++i)
      {
        const std::int32_t row = ordered(k, 2) * cells[1] + ordered(j, 1);
        visit(medium.finder.roots[row * cells[0] + ordered(i, 0)]);
      }
    }
  }
  if (parts.ends.empty())
  {
    parts.ends.push_back(0);
  }
  return parts;
}

template TreeParts divideTree(
  const MediumView<float>&, std::size_t, const Vec3<double>&, std::size_t);
template TreeParts divideTree(
  const MediumView<double>&, std::size_t, const Vec3<double>&, std::size_t);

} // namespace schlieren
