// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/OneLayer.h"

#include "Input/BetweenPlanes.h"
#include "Input/FlatData.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace filters
{

namespace
{

constexpr double angleTolerance = 1e-4; // radians
/// Wider wedges are sectors of flows that need not be axisymmetric.
constexpr double widestWedge = 30; // degrees
constexpr double nearAxis = 0.01;  // of the radius
/// Distance between points that may have been merged, in tolerances.
constexpr double merged = 10;

/// Polar coordinates of a point around an axis.
struct Polar
{
  double angle, distance;

  Polar(const Place& place, std::size_t axis, const Place& origin)
  {
    const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
    this->angle = std::atan2(place[c] - origin[c], place[b] - origin[b]);
    this->distance = std::hypot(place[b] - origin[b], place[c] - origin[c]);
  }
};

/// Returns the angle between two directions, -pi to pi.
double turn(double from, double to) { return std::remainder(to - from, 2 * vtkMath::Pi()); }

/// Returns the two angles at which all points lie; nothing if there are not exactly two.
std::optional<std::array<double, 2>> anglesOf(const std::vector<vtkDataSet*>& pieces,
  std::size_t axis, const Place& origin, const vtkBoundingBox& box)
{
  double most[3]; // distance from the origin
  for (std::size_t i = 0; i < 3; ++i)
  {
    const int low = 2 * static_cast<int>(i);
    most[i] = std::max(
      std::abs(box.GetBound(low) - origin[i]), std::abs(box.GetBound(low + 1) - origin[i]));
  }
  // Points of both planes may have been merged near the axis.
  const double least = nearAxis * std::hypot(most[(axis + 1) % 3], most[(axis + 2) % 3]);
  std::vector<double> angles;
  for (vtkDataSet* data : pieces)
  {
    for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
    {
      const Polar polar(placeOf(data, point), axis, origin);
      const double tolerance =
        angleTolerance + planeTolerance * box.GetMaxLength() / polar.distance;
      if (polar.distance <= least ||
        std::any_of(angles.begin(), angles.end(),
          [&](double known) { return std::abs(turn(known, polar.angle)) <= tolerance; }))
      {
        continue;
      }
      angles.push_back(polar.angle);
      if (angles.size() > 2)
      {
        return std::nullopt;
      }
    }
  }
  if (angles.size() != 2 ||
    !(std::abs(turn(angles[0], angles[1])) <= vtkMath::RadiansFromDegrees(widestWedge)))
  {
    return std::nullopt;
  }
  if (turn(angles[0], angles[1]) < 0)
  {
    std::swap(angles[0], angles[1]);
  }
  return std::array<double, 2>{ angles[0], angles[1] };
}

} // namespace

void flattenLayer(Flow& flow, const Flow* like)
{
  const vtkBoundingBox box = boundsOfLayers(flow);
  if ((like && !like->isOneCellThick) || !box.IsValid())
  {
    return;
  }
  std::array<std::size_t, 3> axes{ 2, 1, 0 };
  std::stable_sort(axes.begin(), axes.end(),
    [&](std::size_t a, std::size_t b)
    { return box.GetLength(static_cast<int>(a)) < box.GetLength(static_cast<int>(b)); });
  for (const std::size_t axis : axes)
  {
    const double low = box.GetBound(2 * static_cast<int>(axis)),
                 high = box.GetBound(2 * static_cast<int>(axis) + 1);
    const double tolerance = planeTolerance * box.GetMaxLength();
    if (!(high - low > 10 * tolerance))
    {
      continue;
    }
    const auto sideAt = [=](const Place& place)
    {
      return std::abs(place[axis] - low) <= tolerance ? Front
        : std::abs(place[axis] - high) <= tolerance   ? Back
                                                      : Neither;
    };
    const auto onPlane = [=](Place place)
    {
      place[axis] = 0.5 * (low + high);
      return place;
    };
    const auto areOneAt = [](const Place&) { return false; };
    if (flatten(flow, { sideAt, onPlane, areOneAt, tolerance }, like != nullptr))
    {
      flow.isOneCellThick = true;
      flow.depth = flow.isDepthGiven ? flow.depth : high - low;
      return;
    }
  }
}

LayerBounds layerBoundsOf(vtkDataSet* data)
{
  LayerBounds layer{};
  data->GetBounds(layer.bounds.data());
  const double tolerance = planeTolerance * vtkBoundingBox(layer.bounds.data()).GetMaxLength();
  layer.isAtBounds.fill(true);
  const std::array<bool, 3> none{};
  for (vtkIdType point = 0; point < data->GetNumberOfPoints() && layer.isAtBounds != none; ++point)
  {
    const Place place = placeOf(data, point);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double toLow = place[axis] - layer.bounds[2 * axis],
                   toHigh = layer.bounds[2 * axis + 1] - place[axis];
      layer.isAtBounds[axis] = layer.isAtBounds[axis] && std::min(toLow, toHigh) <= tolerance;
    }
  }
  return layer;
}

bool areOneLayer(const std::vector<LayerBounds>& pieces)
{
  vtkBoundingBox box;
  for (const LayerBounds& piece : pieces)
  {
    box.AddBounds(piece.bounds.data());
  }
  const double tolerance = planeTolerance * box.GetMaxLength();
  const auto isLayerAlong = [&](std::size_t axis)
  {
    const int low = 2 * static_cast<int>(axis);
    return std::all_of(pieces.begin(), pieces.end(),
      [&](const LayerBounds& piece)
      {
        return piece.isAtBounds[axis] &&
          std::abs(piece.bounds[2 * axis] - box.GetBound(low)) <= tolerance &&
          std::abs(piece.bounds[2 * axis + 1] - box.GetBound(low + 1)) <= tolerance;
      });
  };
  return !pieces.empty() && (isLayerAlong(0) || isLayerAlong(1) || isLayerAlong(2));
}

std::optional<Wedge> findWedge(
  const std::vector<vtkDataSet*>& pieces, const std::array<double, 3>& origin)
{
  vtkBoundingBox box;
  for (vtkDataSet* data : pieces)
  {
    box.AddBounds(data->GetBounds());
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (const auto angles = anglesOf(pieces, axis, origin, box))
    {
      const double middle = (*angles)[0] + 0.5 * turn((*angles)[0], (*angles)[1]);
      const bool isAlongNext = std::abs(std::cos(middle)) >= std::abs(std::sin(middle));
      return Wedge{ static_cast<int>(axis), static_cast<int>((axis + (isAlongNext ? 2 : 1)) % 3),
        *angles, vtkMath::DegreesFromRadians(turn((*angles)[0], (*angles)[1])) };
    }
  }
  return std::nullopt;
}

bool flattenWedge(Flow& flow, const Wedge& wedge, const std::array<double, 3>& origin)
{
  const auto axis = static_cast<std::size_t>(wedge.axis),
             across = static_cast<std::size_t>(wedge.across);
  const std::size_t away = 3 - axis - across;
  const double size = boundsOfLayers(flow).GetMaxLength();
  const auto [front, back] = wedge.angles;
  const auto sideAt = [=, front = front, back = back](const Place& place)
  {
    const Polar polar(place, axis, origin);
    return polar.distance <= planeTolerance * size                             ? Both
      : std::abs(turn(front, polar.angle)) < std::abs(turn(back, polar.angle)) ? Front
                                                                               : Back;
  };
  // Keeps the radius of points; projects centres of cells to the middle plane, nearer to the axis.
  const double nearer = flow.leaves[0].ofCells ? std::cos(0.5 * turn(front, back)) : 1;
  const auto onPlane = [=](const Place& place)
  {
    Place on = origin;
    on[axis] = place[axis];
    on[away] += nearer * Polar(place, axis, origin).distance;
    return on;
  };
  const double tolerance = planeTolerance * size;
  const auto areOneAt = [=, width = 2 * std::sin(0.5 * turn(front, back))](const Place& place)
  { return width * Polar(place, axis, origin).distance <= merged * tolerance; };
  return flatten(flow, { sideAt, onPlane, areOneAt, tolerance }, true);
}

} // namespace filters
