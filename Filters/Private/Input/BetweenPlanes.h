// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/Flow.h"

#include "vtkBoundingBox.h"
#include "vtkDataSet.h"

#include <array>
#include <functional>

/// Cells between two planes, replaced by flat ones halfway between them.
namespace filters
{

using Place = std::array<double, 3>;

inline Place placeOf(vtkDataSet* data, vtkIdType point)
{
  Place place;
  data->GetPoint(point, place.data());
  return place;
}

enum Side : signed char
{
  Front = -1,
  Both = 0, // on the axis where two planes meet
  Back = 1,
  Neither = 2
};

/// Two planes: the side of a point, its projection to the plane halfway between them, and whether
/// they are so close there that a mesh may have one point for both.
struct Planes
{
  std::function<Side(const Place&)> sideAt;
  std::function<Place(const Place&)> onPlane;
  std::function<bool(const Place&)> areOneAt;
  double tolerance; // of distances
};

/// Returns whether data have 3-D cells: others beside a layer are its faces.
bool isLayerLeaf(const Leaf& leaf);
vtkBoundingBox boundsOfLayers(const Flow& flow);

/// Replaces the flow by flat data with the front's values if its 3-D cells are one layer between
/// the planes; else returns false. `areValuesFree`: values may differ between the planes. vtkCutter
/// takes as long as the whole image, and vtkPlaneCutter makes triangles of quadrilaterals.
bool flatten(Flow& flow, const Planes& planes, bool areValuesFree);

} // namespace filters
