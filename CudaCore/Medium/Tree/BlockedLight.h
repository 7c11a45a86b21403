// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Samples/MediumSource.h"
#include "Medium/Tree/BrickRays.h"
#include "Types.h"

#include <array>
#include <cstdint>
#include <vector>

namespace schlieren
{

/// Which lines of sight of a column meet boxes that stop all light: what else is on them is not seen.
///
/// Known on a lattice with two pixels between its points, or with more where there would be too many. Between boxes that
/// stop light there is a box as large as they are, or larger, wherever light may pass, and it is refined until they are
/// so small that points of the lattice are between them.
class BlockedLight
{
public:
  BlockedLight() = default;
  BlockedLight(const Grid& grid, const Column& column);

  /// A box that stops all light; index coordinates.
  void add(const Box& box);
  /// After the last one.
  void finish();

  /// Whether all light is blocked on the lines of sight through a box, and on those that are as far beside them as
  /// light may be that deviates by the sine `slope` from them.
  bool isDark(const Box& box, double slope) const;

private:
  struct Places
  {
    std::array<double, 2> low, high; ///< in points of the lattice
    double
      narrowest; ///< of the column there, by its width in the image's plane; not positive: anywhere
  };
  Places placesOf(const Box& box) const;

  Grid grid_{};
  Column column_{};
  std::array<double, 2> first_{}, spacing_{};
  std::array<int, 2> points_{ 0, 0 };
  double depth_ = 0; ///< of the grid along the light
  std::vector<unsigned char> isBlocked_;
  std::vector<std::int32_t>
    unblocked_; ///< before a row and a column: one more of each than there are points
};

} // namespace schlieren
