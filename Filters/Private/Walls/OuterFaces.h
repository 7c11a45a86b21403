// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Triangles.h"

#include <vector>

namespace filters
{

/**
 * Which triangles of the boundary of a domain are outer ones (far field, symmetry planes, inlets, outlets, walls
 * of pipes and tunnels); the others are of bodies.
 *
 * A triangle on the convex hull of the domain, with all points on one side of its plane, is outer. So are far
 * fields, pipes and boxes, whichever way they are turned; bodies are not: spheres in their mesh, half models on
 * their symmetry plane, fins, steps and holes, also where they reach to the side of the domain.
 *
 * The others hang together at their edges (of two of them). Such a part is outer as a whole
 * - if it continues smoothly (by less than 35 degrees) from curved triangles of the hull: the inner side of an
 *   elbow. What continues from flat sides of the domain is a body: a ramp, a bump in the floor;
 * - or if it touches the domain's bounding box where the hull does not face that side of the box: the wall of a
 *   nozzle, whose inlet is at its widest place.
 *
 * `rounding`: see relativeRounding(). `axes`: along which there is an outside; 2: not along z.
 */
std::vector<unsigned char> findOuter(
  const Triangles& surface, const TriangleTree& tree, double rounding, std::size_t axes = 3);

} // namespace filters
