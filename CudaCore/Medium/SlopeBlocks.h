// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How steep the medium is where: what bounds on rays are made of.
#pragma once

#include "Math/Vec3.h"

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

} // namespace schlieren
