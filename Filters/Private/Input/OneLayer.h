// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/Flow.h"

#include <array>
#include <optional>
#include <vector>

/// Flattens meshes of one layer of cells, in which 3-D solvers compute 2-D and axisymmetric flows.
namespace filters
{

/// Replaces a layer between two planes across a coordinate axis by flat data halfway between them,
/// with its depth unless one is given. Keeps other data, and layers whose point values differ
/// between the planes. `like`: the flow of other arrays of the input, which decides; may be null.
void flattenLayer(Flow& flow, const Flow* like);

/// The bounds of data, and along which axes all points lie at one of the two.
struct LayerBounds
{
  std::array<double, 6> bounds;
  std::array<bool, 3> isAtBounds;
};
LayerBounds layerBoundsOf(vtkDataSet* data);
/// Returns whether data with these bounds are one layer together, between the same two planes.
bool areOneLayer(const std::vector<LayerBounds>& pieces);

/// A layer between two planes that meet in an axis.
struct Wedge
{
  int axis, across;             // along the wedge, and nearest to the normal of its middle plane
  std::array<double, 2> angles; // of the planes, around the axis
  double degrees;               // between them
};

/// Returns nothing if the 3-D cells are no wedge.
std::optional<Wedge> findWedge(
  const std::vector<vtkDataSet*>& pieces, const std::array<double, 3>& origin);

/// Replaces the wedge by flat data across `across`, with the coordinates x along the axis and r.
/// Returns false if it is not one layer of cells.
bool flattenWedge(Flow& flow, const Wedge& wedge, const std::array<double, 3>& origin);

} // namespace filters
