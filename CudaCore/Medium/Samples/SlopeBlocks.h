// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How steep the medium is where: what bounds on rays are made of.
#pragma once

#include "Math/Vec3.h"

#include <cmath>
#include <vector>

namespace schlieren
{

/// A cube of voxels (of an image it may reach past the last one), and the largest |d nu / d index| in it, axis by axis.
/// The memory of an image grows by 1.4 % for them.
struct SlopeBlock
{
  static constexpr int voxels = 8; ///< along its edges

  Vec3<float> low; ///< index coordinates
  float edge;      ///< likewise
  Vec3<float> slope;

  Vec3<float> high() const { return { low.x + edge, low.y + edge, low.z + edge }; }
};

/// Cubes in which nothing bends light are left out.
using SlopeBlocks = std::vector<SlopeBlock>;

/// Where nu changes most from voxel to voxel.
struct SteepestPlace
{
  double perVoxel = 0;        ///< no change of nu over one voxel is larger
  Vec3<double> at{ 0, 0, 0 }; ///< index coordinates, to half a block
};

inline SteepestPlace findSteepest(const SlopeBlocks& blocks)
{
  SteepestPlace steepest;
  for (const SlopeBlock& block : blocks)
  {
    const double perVoxel = static_cast<double>(block.edge) / SlopeBlock::voxels *
      length(static_cast<Vec3<double>>(block.slope));
    if (perVoxel > steepest.perVoxel)
    {
      const double half = 0.5 * static_cast<double>(block.edge);
      steepest = { perVoxel,
        static_cast<Vec3<double>>(block.low) + Vec3<double>{ half, half, half } };
    }
  }
  return steepest;
}

} // namespace schlieren
