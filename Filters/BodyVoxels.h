// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace filters
{

/// A connected surface, in index coordinates of a grid whose points are 0 ... dimensions - 1.
struct Surface
{
  using Triangle = std::array<std::size_t, 3>; ///< indices of points

  const std::vector<std::array<double, 3>>& points; ///< finite
  std::vector<Triangle> triangles;
};

/// Whether the edge ab, projected along x, lies at z and on the far side of y. The same for both
/// triangles that share it, to the last bit, so that no line slips through between them.
bool isPassed(std::array<double, 3> a, std::array<double, 3> b, double y, double z);

/// Whether every edge belongs to an even number of triangles, so that there is an inside.
bool isClosed(const Surface& surface);

/// Calls mark(i, j, k) for the grid points that must be solid for light to be stopped by the surface,
/// some of them more than once:
/// - the points inside a closed surface, whichever way its triangles face (of two opposite faces that
///   meet grid points, one is counted in);
/// - where an open surface, or a closed one that is thin, goes between two points that are not inside,
///   on the segment from one to its neighbour along an axis or a diagonal: the nearer one.
/// So no way that goes from one side to the other in moves of at most one voxel along each axis misses
/// them. (In 3-D digital geometry: they are 26-separating; Cohen-Or & Kaufman 1995.)
void voxelize(const Surface& surface, const std::array<int, 3>& dimensions,
  const std::function<void(int, int, int)>& mark);

} // namespace filters
