// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace refractivity
{

/// A connected surface, in index coordinates of a grid whose points are 0 ... dimensions - 1.
struct Surface
{
  using Triangle = std::array<std::size_t, 3>; ///< indices of points

  const std::vector<std::array<double, 3>>& points; ///< finite
  std::vector<Triangle> triangles;
};

/// Whether every edge belongs to an even number of triangles, so that there is an inside.
bool isClosed(const Surface& surface);

/// Calls mark(i, j, k) for the grid points that must be solid for light to be stopped by the surface,
/// some of them more than once. A closed surface: the points inside (whichever way the triangles
/// face; of two opposite faces that meet grid points, one is counted in). An open one, and where a
/// closed one is too thin to be sure of points inside: all points whose voxel the surface meets, so that
/// any way that goes from one side to the other in moves of at most one voxel along each axis meets
/// one of them (the "supercover"; Cohen-Or & Kaufman 1995).
void voxelize(const Surface& surface, const std::array<int, 3>& dimensions,
  const std::function<void(int, int, int)>& mark);

} // namespace refractivity
