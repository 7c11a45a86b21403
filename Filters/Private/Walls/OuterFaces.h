// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/Triangles.h"

#include <vector>

namespace filters
{

/**
 * Finds the outer triangles of a domain's boundary (far field, symmetry planes, inlets, outlets,
 * walls of pipes and tunnels); the others are of bodies.
 *
 * A triangle on the convex hull of the domain, with all points on one side of its plane, is outer.
 * So are far fields, pipes and boxes in any orientation; bodies are not: spheres in their mesh,
 * half models on their symmetry plane, fins, steps and holes, also where they reach to the side of
 * the domain.
 *
 * A set of other triangles, connected at edges of two, is outer as a whole
 * - if it continues smoothly (by less than 35 degrees) from curved triangles of the hull: the inner
 *   side of an elbow. Continuations of flat sides are bodies: a ramp, a bump in the floor;
 * - or if it touches the domain's bounding box where the hull does not face that side of the box:
 *   the wall of a nozzle, whose inlet is at its widest cross-section.
 *
 * `rounding`: see relativeRounding(). `axes`: along which there is an outside; 2: not along z.
 */
std::vector<unsigned char> findOuter(
  const Triangles& surface, const TriangleTree& tree, double rounding, std::size_t axes = 3);

} // namespace filters
