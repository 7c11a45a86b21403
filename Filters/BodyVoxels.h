// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "BodySurfaces.h"

#include <array>
#include <functional>

namespace filters
{

/// Calls mark(i, j, k) for the points of a grid that must be solid for light to be stopped by bodies, some of them more
/// than once. The bodies are in index coordinates of the grid, whose points are 0 ... dimensions - 1:
/// - the points inside closed surfaces, whichever way their triangles face (of two opposite faces that
///   meet grid points, one is counted in);
/// - where an open surface, or a closed one that is thin, goes between two points that are not inside,
///   on the segment from one to its neighbour along an axis or a diagonal: the nearer one.
/// So no way that goes from one side to the other in moves of at most one voxel along each axis misses
/// them. (In 3-D digital geometry: they are 26-separating; Cohen-Or & Kaufman 1995.)
void voxelize(const BodySurfaces& bodies, const std::array<int, 3>& dimensions,
  const std::function<void(int, int, int)>& mark);

} // namespace filters
