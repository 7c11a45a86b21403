// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the errors of a brick's gradients add up to along straight light: with their signs, since a ray does not see what
// cancels out along it.
#pragma once

#include "Medium/Samples/Leaves.h"

#include <array>
#include <cstddef>
#include <vector>

namespace schlieren
{

/// Directions of lines through the samples of a brick, counted in voxels: along its edges, the diagonals of its faces and
/// its own. Any other one lies between three of them.
inline constexpr std::array<std::array<int, 3>, 13> lineDirections{ { { 1, 0, 0 }, { 0, 1, 0 },
  { 0, 0, 1 }, { 1, 1, 0 }, { -1, 1, 0 }, { 1, 0, 1 }, { -1, 0, 1 }, { 0, 1, 1 }, { 0, -1, 1 },
  { 1, 1, 1 }, { -1, 1, 1 }, { 1, -1, 1 }, { -1, -1, 1 } } };

/// Errors of the deflection of rays through a brick, because of its gradients along each axis; by the direction of rays.
struct LineErrors
{
  using ByDirection = std::array<std::array<float, 3>, lineDirections.size()>;
  ByDirection largest{}; ///< of all lines
  ByDirection typical{}; ///< root of the mean square over all lines
  ByDirection
    largestAtEdges{}; ///< the largest of gradients beside places where gas ends, which few lines meet

  void scale(float factor);

  struct Error
  {
    double largest, largestAtEdges, typical;
  };
  /// The errors of rays along a direction, counted in voxels, because of the gradients along axes that count.
  Error along(const Vec3<double>& direction, const std::array<bool, 3>& counts) const;
};

/// Where gradients are wrong.
enum class GradientsOf
{
  Gas,  ///< with gas around
  Edges ///< beside places where gas ends
};

/// Adds up `errors` of the gradient along an axis (nu by voxel) at 16^3 places, x fastest; or at 16^2 of a layer, along
/// whose depth nothing changes: there, errors are those over a path as long as the layer's edge. `voxel`: its edges.
void addLines(const std::vector<float>& errors, std::size_t axis, BrickShape shape,
  const std::array<double, 3>& voxel, GradientsOf which, LineErrors& to);

} // namespace schlieren
