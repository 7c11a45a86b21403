// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace schlieren
{

/// The most that nu may change by voxel with Integrator::Leapfrog: steps of one voxel keep |p| = 1 + nu to a few
/// thousandths then. Where it changes more, as at faces of glass, light is not nearly straight in a leaf.
constexpr double largestChangeByVoxel = 0.05;

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
