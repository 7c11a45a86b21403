// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/RefractivitySource.h"

#include <array>
#include <optional>

/// Data that are one layer of cells, as those of 2-D and axisymmetric flows of solvers whose meshes are three-dimensional.
namespace filters
{

/// Makes flat data of a layer between two planes across a coordinate axis, halfway between them; their depth is that of the
/// layer, unless it is given. Other data stay as they are, and so do those whose values at points differ from one plane to
/// the other. `like`: what was made of other arrays of the same input, which then decides; may be null.
void flattenLayer(Source& source, const Source* like);

/// A layer between two planes that meet in an axis.
struct Wedge
{
  int axis, across; // the coordinate axes along it, and nearest to the normal of its middle plane
  double degrees;
};

/// Nothing where the 3-D cells are no such layer.
std::optional<Wedge> findWedge(const Source& source, const std::array<double, 3>& origin);

/// Makes flat data of it, across `across`: places along the axis and away from it by their distance.
void flattenWedge(Source& source, const Wedge& wedge, const std::array<double, 3>& origin);

} // namespace filters
