// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace schlieren
{

/// Where nu changes most from voxel to voxel.
struct SteepestPlace
{
  double perVoxel = 0;                 ///< no change of nu over one voxel is larger
  std::array<double, 3> at{ 0, 0, 0 }; ///< index coordinates, about

  void include(const SteepestPlace& other)
  {
    if (other.perVoxel > perVoxel)
    {
      *this = other;
    }
  }
};

} // namespace schlieren
