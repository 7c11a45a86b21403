// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/OneLayer.h"

#include "Input/FlatData.h"

#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkGenericCell.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace filters
{

namespace
{

using Place = std::array<double, 3>;

/// Relative distance of points from their plane that rounding in single precision explains.
constexpr double planeTolerance = 1e-6;
constexpr double angleTolerance = 1e-4; // radians
/// Wider wedges are sectors of flows that need not be axisymmetric.
constexpr double widestWedge = 30; // degrees
/// Relative difference of values between the planes: text files have six digits.
constexpr double valueTolerance = 1e-5;

enum Side : signed char
{
  Front = -1,
  Both = 0, // on the axis where two planes meet
  Back = 1,
  Neither = 2
};
using Sides = std::vector<signed char>;

Place placeOf(vtkDataSet* data, vtkIdType point)
{
  Place place;
  data->GetPoint(point, place.data());
  return place;
}

bool isLayerLeaf(const Leaf& leaf) { return dimensionOf(leaf.data) == 3; }

/// Returns the sides of all points; empty if a point is on neither plane.
template <class SideAt>
Sides sidesOf(vtkDataSet* data, const SideAt& sideAt)
{
  Sides sides(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
  {
    const Side side = sideAt(placeOf(data, point));
    if (side == Neither)
    {
      return {};
    }
    sides[static_cast<std::size_t>(point)] = side;
  }
  return sides;
}

/// Two planes: the side of a point, and its projection to the plane halfway between them.
struct Planes
{
  std::function<Side(const Place&)> sideAt;
  std::function<Place(const Place&)> onPlane;
  double tolerance; // of distances
};

/// A point in front and the one behind it.
using Pair = std::pair<vtkIdType, vtkIdType>;

/// Returns the axis of structured data along which pairs of points change sides; -1: none.
int axisAcross(const std::array<int, 3>& points, const Sides& sides)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (points[axis] != 2)
    {
      continue;
    }
    std::size_t stride = 1;
    for (std::size_t before = 0; before < axis; ++before)
    {
      stride *= static_cast<std::size_t>(points[before]);
    }
    bool isAcross = true;
    for (std::size_t point = 0; point < sides.size() && isAcross; ++point)
    {
      const signed char side = sides[point];
      const bool isSecond = point / stride % 2 == 1;
      isAcross = side == Both || (side == sides[isSecond ? point - stride : point]) != isSecond;
    }
    // Requires that the same layer is in front everywhere.
    signed char first = Both;
    for (std::size_t point = 0; point < sides.size() && isAcross; ++point)
    {
      if (point / stride % 2 == 0 && sides[point] != Both)
      {
        isAcross = first == Both || first == sides[point];
        first = sides[point];
      }
    }
    if (isAcross && first != Both)
    {
      return static_cast<int>(axis);
    }
  }
  return -1;
}

/// Keeps images, so that blocks of images remain AMR levels.
vtkSmartPointer<vtkDataSet> planeOfImage(vtkImageData* image, int across)
{
  int extent[6];
  image->GetExtent(extent);
  double middle[3], place[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    middle[axis] = axis == across ? 0.5 * (extent[2 * axis] + extent[2 * axis + 1]) : 0;
  }
  image->TransformContinuousIndexToPhysicalPoint(middle, place);
  extent[2 * across] = extent[2 * across + 1] = 0;
  auto plane = vtkSmartPointer<vtkImageData>::New();
  plane->SetExtent(extent);
  plane->SetOrigin(place);
  plane->SetSpacing(image->GetSpacing());
  plane->SetDirectionMatrix(image->GetDirectionMatrix());
  return plane;
}

/// Extracts the front layer of structured data, and the pairs of points.
void flattenStructured(const Leaf& leaf, std::array<int, 3> points, int across,
  const Planes& planes, Remade& made, std::vector<Pair>& pairs)
{
  const auto axis = static_cast<std::size_t>(across);
  const std::array<int, 3> before = points;
  points[axis] = 1;
  const vtkIdType stride =
    axis == 0 ? 1 : (axis == 1 ? before[0] : vtkIdType{ before[0] } * before[1]);
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  for (int k = 0; k < points[2]; ++k)
  {
    for (int j = 0; j < points[1]; ++j)
    {
      for (int i = 0; i < points[0]; ++i)
      {
        const vtkIdType point = (vtkIdType{ k } * before[1] + j) * before[0] + i;
        places->InsertNextPoint(planes.onPlane(placeOf(leaf.data, point)).data());
        made.points->InsertNextId(point);
        pairs.emplace_back(point, point + stride);
      }
    }
  }
  made.cells->SetNumberOfIds(leaf.data->GetNumberOfCells());
  std::iota(made.cells->begin(), made.cells->end(), vtkIdType{ 0 });
  if (auto* image = vtkImageData::SafeDownCast(leaf.data))
  {
    made.data = planeOfImage(image, across);
    return;
  }
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(points.data());
  grid->SetPoints(places);
  made.data = grid;
}

/// Finds the front faces of cells in a mesh of one layer.
class Layer
{
public:
  Layer(vtkDataSet* data, const Sides& sides, const Planes& planes)
    : Data(data)
    , Of(sides)
    , Nearest(10 * planes.tolerance)
    , Places(sides.size())
  {
    for (std::size_t point = 0; point < sides.size(); ++point)
    {
      this->Places[point] = planes.onPlane(placeOf(data, static_cast<vtkIdType>(point)));
    }
  }

  const Place& placeAt(vtkIdType point) const
  {
    return this->Places[static_cast<std::size_t>(point)];
  }

  /// Returns the ordered corners of a cell's front face, until the next call; empty: none.
  std::vector<vtkIdType>& front(vtkIdType cell)
  {
    this->Data->GetCell(cell, this->Cell);
    for (int i = 0; i < this->Cell->GetNumberOfFaces(); ++i)
    {
      this->Corners.clear();
      vtkCell* side = this->Cell->GetFace(i);
      vtkIdList* ids = side->GetPointIds();
      if (side->GetCellType() == VTK_PIXEL)
      {
        std::swap(*ids->GetPointer(2), *ids->GetPointer(3)); // makes it a quadrilateral
      }
      std::for_each(ids->begin(), ids->end(), [this](vtkIdType point) { this->add(point); });
      if (this->areInFront())
      {
        return this->Corners;
      }
    }
    this->Corners.clear();
    return this->Corners;
  }

  /// Returns the point behind one of the last cell; -1: none.
  vtkIdType behind(vtkIdType point) const
  {
    vtkIdType found = -1;
    double least = this->Nearest * this->Nearest;
    for (int i = 0; i < this->Cell->GetNumberOfPoints(); ++i)
    {
      const vtkIdType other = this->Cell->GetPointId(i);
      if (this->sideOf(other) == Back)
      {
        const double distance =
          vtkMath::Distance2BetweenPoints(this->placeAt(point).data(), this->placeAt(other).data());
        found = distance <= least ? other : found;
        least = std::min(least, distance);
      }
    }
    return found;
  }

  bool isOnAxis(vtkIdType point) const { return this->sideOf(point) == Both; }

private:
  signed char sideOf(vtkIdType point) const { return this->Of[static_cast<std::size_t>(point)]; }
  void add(vtkIdType point)
  {
    const auto end = this->Corners.end();
    if (std::find(this->Corners.begin(), end, point) == end) // else a side is collapsed
    {
      this->Corners.push_back(point);
    }
  }
  bool areInFront() const
  {
    const auto begin = this->Corners.begin(), end = this->Corners.end();
    return this->Corners.size() > 2 &&
      std::all_of(begin, end, [this](vtkIdType i) { return this->sideOf(i) <= Both; }) &&
      std::any_of(begin, end, [this](vtkIdType i) { return this->sideOf(i) == Front; });
  }

  vtkDataSet* Data;
  const Sides& Of;
  double Nearest;            // tolerance of the distance of a pair in the plane
  std::vector<Place> Places; // projections to the plane
  vtkNew<vtkGenericCell> Cell;
  std::vector<vtkIdType> Corners;
};

/// Returns false if the cells are no layer.
bool flattenCells(const Leaf& leaf, const Sides& sides, const Planes& planes, Remade& made,
  std::vector<Pair>& pairs)
{
  vtkDataSet* data = leaf.data;
  Layer layer(data, sides, planes);
  std::vector<vtkIdType> numbers(sides.size(), -1);
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  mesh->SetPoints(places);
  mesh->Allocate(data->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    if (dimensionOfCell(data, cell) != 3)
    {
      continue;
    }
    std::vector<vtkIdType>& face = layer.front(cell);
    if (face.empty())
    {
      return false;
    }
    for (vtkIdType& corner : face)
    {
      vtkIdType& number = numbers[static_cast<std::size_t>(corner)];
      if (number < 0)
      {
        const vtkIdType other = layer.isOnAxis(corner) ? corner : layer.behind(corner);
        if (other < 0)
        {
          return false;
        }
        pairs.emplace_back(corner, other);
        number = places->InsertNextPoint(layer.placeAt(corner).data());
        made.points->InsertNextId(corner);
      }
      corner = number;
    }
    const auto count = static_cast<vtkIdType>(face.size());
    mesh->InsertNextCell(
      count == 3 ? VTK_TRIANGLE : (count == 4 ? VTK_QUAD : VTK_POLYGON), count, face.data());
    made.cells->InsertNextId(cell);
  }
  made.data = mesh;
  return true;
}

bool areSame(const Leaf& leaf, const std::vector<Pair>& pairs)
{
  for (vtkDataArray* array : leaf.arrays)
  {
    double range[2];
    array->GetFiniteRange(range, 0);
    const double most = valueTolerance * (range[1] - range[0]) +
      8 * std::numeric_limits<float>::epsilon() * std::max(std::abs(range[0]), std::abs(range[1]));
    for (const Pair& pair : pairs)
    {
      const double a = array->GetComponent(pair.first, 0), b = array->GetComponent(pair.second, 0);
      if (!(std::abs(a - b) <= most) && !(std::isnan(a) && std::isnan(b)))
      {
        return false;
      }
    }
  }
  return true;
}

/// Flattens the source if it is a layer. `areValuesFree`: values may differ between the planes.
bool flatten(Source& source, const Planes& planes, bool areValuesFree)
{
  std::vector<Leaf> leaves;
  std::vector<vtkSmartPointer<vtkDataSet>> made;
  for (const Leaf& leaf : source.leaves)
  {
    if (!isLayerLeaf(leaf))
    {
      continue; // 2-D cells are faces of the layer's
    }
    const Sides sides = sidesOf(leaf.data, planes.sideAt);
    if (sides.empty())
    {
      return false;
    }
    Remade flat;
    std::vector<Pair> pairs;
    const std::array<int, 3> points = structureOf(leaf.data);
    const int across = points[0] > 0 ? axisAcross(points, sides) : -1;
    if (across >= 0)
    {
      flattenStructured(leaf, points, across, planes, flat, pairs);
    }
    else if (!flattenCells(leaf, sides, planes, flat, pairs))
    {
      return false;
    }
    if (!areValuesFree && !leaf.ofCells && !areSame(leaf, pairs))
    {
      return false;
    }
    leaves.push_back(flat.leafOf(leaf));
    made.push_back(flat.data);
  }
  if (source.image)
  {
    source.image = vtkImageData::SafeDownCast(leaves.at(0).data);
  }
  source.leaves = std::move(leaves);
  source.made.insert(source.made.end(), made.begin(), made.end());
  return true;
}

vtkBoundingBox boundsOfLayers(const Source& source)
{
  vtkBoundingBox box;
  for (const Leaf& leaf : source.leaves)
  {
    if (isLayerLeaf(leaf))
    {
      box.AddBounds(leaf.data->GetBounds());
    }
  }
  return box;
}

} // namespace

void flattenLayer(Source& source, const Source* like)
{
  const vtkBoundingBox box = boundsOfLayers(source);
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
    Planes planes;
    planes.tolerance = tolerance;
    planes.sideAt = [=](const Place& place)
    {
      return std::abs(place[axis] - low) <= tolerance ? Front
        : std::abs(place[axis] - high) <= tolerance   ? Back
                                                      : Neither;
    };
    planes.onPlane = [=](Place place)
    {
      place[axis] = 0.5 * (low + high);
      return place;
    };
    if (flatten(source, planes, like != nullptr))
    {
      source.isOneCellThick = true;
      source.depth = source.isDepthGiven ? source.depth : high - low;
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

namespace
{

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
std::optional<std::array<double, 2>> anglesOf(
  const Source& source, std::size_t axis, const Place& origin, double size)
{
  std::vector<double> angles;
  for (const Leaf& leaf : source.leaves)
  {
    const vtkIdType count = isLayerLeaf(leaf) ? leaf.data->GetNumberOfPoints() : 0;
    for (vtkIdType point = 0; point < count; ++point)
    {
      const Polar polar(placeOf(leaf.data, point), axis, origin);
      const double tolerance = angleTolerance + planeTolerance * size / polar.distance;
      if (polar.distance <= planeTolerance * size ||
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

std::optional<Wedge> findWedge(const Source& source, const std::array<double, 3>& origin)
{
  const double size = boundsOfLayers(source).GetMaxLength();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (const auto angles = anglesOf(source, axis, origin, size))
    {
      const double middle = (*angles)[0] + 0.5 * turn((*angles)[0], (*angles)[1]);
      const bool isAlongNext = std::abs(std::cos(middle)) >= std::abs(std::sin(middle));
      return Wedge{ static_cast<int>(axis), static_cast<int>((axis + (isAlongNext ? 2 : 1)) % 3),
        vtkMath::DegreesFromRadians(turn((*angles)[0], (*angles)[1])) };
    }
  }
  return std::nullopt;
}

void flattenWedge(Source& source, const Wedge& wedge, const std::array<double, 3>& origin)
{
  const auto axis = static_cast<std::size_t>(wedge.axis),
             across = static_cast<std::size_t>(wedge.across);
  const std::size_t away = 3 - axis - across;
  const double size = boundsOfLayers(source).GetMaxLength();
  const auto angles = anglesOf(source, axis, origin, size);
  Planes planes;
  planes.tolerance = planeTolerance * size;
  planes.sideAt = [=](const Place& place)
  {
    const Polar polar(place, axis, origin);
    return polar.distance <= planeTolerance * size ? Both
      : std::abs(turn((*angles)[0], polar.angle)) < std::abs(turn((*angles)[1], polar.angle))
      ? Front
      : Back;
  };
  // Keeps the radius of points; projects centres of cells to the middle plane, nearer to the axis.
  const double nearer =
    angles && source.leaves[0].ofCells ? std::cos(0.5 * turn((*angles)[0], (*angles)[1])) : 1;
  planes.onPlane = [=](const Place& place)
  {
    Place on = origin;
    on[axis] = place[axis];
    on[away] += nearer * Polar(place, axis, origin).distance;
    return on;
  };
  if (!angles || !flatten(source, planes, true))
  {
    throw std::runtime_error(
      "Symmetry is Axisymmetric, and the input lies between two planes through the " +
      std::string(1, "xyz"[axis]) +
      " axis, but it is more than one layer of cells. Use a plane (Slice) of it.");
  }
}

} // namespace filters
