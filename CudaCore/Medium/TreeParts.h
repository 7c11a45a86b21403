// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Math/Vec3.h"
#include "Medium/Interpolation.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// The leaves of a tree in parts of no more than so many bytes, for a device that has no memory for all of them.
///
/// They are in the order in which light comes to them: of two cells side by side, the one that lies against the light
/// is first, at all levels. So parallel straight rays go from parts to later ones alone, each of which is needed once.
struct TreeParts
{
  static constexpr std::int32_t none = -1;

  std::vector<std::int32_t>
    ofLeaf; ///< the part of each; none: it has no samples and no map of its own
  std::vector<std::int32_t> leaves; ///< those with a part, part by part
  std::vector<std::size_t> ends;    ///< of each part, in `leaves`

  std::int32_t count() const { return static_cast<std::int32_t>(ends.size()); }
  std::size_t begin(std::int32_t part) const
  {
    return part > 0 ? ends[static_cast<std::size_t>(part) - 1] : 0;
  }
  std::size_t end(std::int32_t part) const { return ends[static_cast<std::size_t>(part)]; }
};

/// `leaves`: how many the tree has. `along`: the direction of light. A part has one leaf at least, and at least one part there is.
template <class Real>
TreeParts divideTree(const MediumView<Real>& medium, std::size_t leaves, const Vec3<double>& along,
  std::size_t bytesOfPart);

} // namespace schlieren
