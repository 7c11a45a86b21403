// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/MediumTree.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// A medium that is divided among processes: all have the tree's structure, each has the samples of its own leaves.
/// Leaves are divided in their own order, which is that of a space-filling curve (Morton 1966) within each root cell, into
/// pieces of as many bytes each. A leaf without samples is on all processes.
template <class Real>
class MediumParts
{
public:
  static constexpr std::int32_t everywhere = -1;

  /// The tree must outlive it, and not change.
  MediumParts(const MediumTree<Real>& tree, std::int32_t count);

  std::int32_t count() const { return count_; }
  std::int32_t ownerOf(std::int32_t leaf) const { return owners_[static_cast<std::size_t>(leaf)]; }

  /// The arrays of one part; bricks are numbered anew.
  struct Part
  {
    std::vector<Leaf<Real>> leaves; ///< all; those of others as Leaf::isResident() has them
    std::vector<Real> samples;
    std::vector<std::int16_t> gasDistances;
    std::vector<float> gradients;
    std::vector<std::int32_t> gradientBricks;
  };
  Part part(std::int32_t owner) const;

  /// The leaves with the bricks' numbers of the tree.
  std::vector<Leaf<Real>> leavesInTree(std::int32_t owner) const;

private:
  bool hasSamples(std::size_t leaf) const;
  bool isElsewhere(std::size_t leaf, std::int32_t owner) const
  {
    return owners_[leaf] != everywhere && owners_[leaf] != owner;
  }

  const MediumTree<Real>& tree_;
  std::int32_t count_;
  std::vector<std::int32_t> owners_; ///< of each leaf
};

} // namespace schlieren
