// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/BetweenPlanes.h"

#include "Input/FlatData.h"

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
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace filters
{

namespace
{

/// Relative difference of values between the planes: text files have six digits.
constexpr double valueTolerance = 1e-5;

using Sides = std::vector<signed char>;

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

/// A point in front and the one behind it.
using Pair = std::pair<vtkIdType, vtkIdType>;

/// Returns the axis of structured data along which pairs of points change sides, with the same layer
/// in front everywhere; -1: none.
int axisAcross(const std::array<int, 3>& points, const Sides& sides)
{
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    signed char first = Both; // the side of the first layer
    bool isAcross = points[axis] == 2;
    for (std::size_t point = 0; point < sides.size() && isAcross; ++point)
    {
      const int side = point / stride % 2 == 0 ? sides[point] : -sides[point];
      isAcross = side == Both || first == Both || side == first;
      first = first == Both ? static_cast<signed char>(side) : first;
    }
    if (isAcross && first != Both)
    {
      return static_cast<int>(axis);
    }
    stride *= static_cast<std::size_t>(points[axis]);
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

/// Extracts the first layer of structured data, and the pairs of points.
void flattenStructured(const Leaf& leaf, std::array<int, 3> points, int across,
  const Planes& planes, Remade& made, std::vector<Pair>& pairs)
{
  vtkIdType stride = 1;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(across); ++axis)
  {
    stride *= points[axis];
  }
  points[static_cast<std::size_t>(across)] = 1;
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  for (vtkIdType point = 0; point < leaf.data->GetNumberOfPoints(); ++point)
  {
    if (point / stride % 2 == 0)
    {
      places->InsertNextPoint(planes.onPlane(placeOf(leaf.data, point)).data());
      made.points->InsertNextId(point);
      pairs.emplace_back(point, point + stride);
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

/// Returns the ordered corners of a cell's front face; empty: none.
template <class SideOf>
std::vector<vtkIdType> frontOf(vtkGenericCell* cell, const SideOf& sideOf)
{
  for (int i = 0; i < cell->GetNumberOfFaces(); ++i)
  {
    vtkCell* face = cell->GetFace(i);
    vtkIdList* ids = face->GetPointIds();
    if (face->GetCellType() == VTK_PIXEL)
    {
      std::swap(*ids->GetPointer(2), *ids->GetPointer(3)); // makes it a quadrilateral
    }
    std::vector<vtkIdType> corners;
    signed char first = Both, last = Both; // of the sides of the corners
    for (vtkIdType corner = 0; corner < ids->GetNumberOfIds(); ++corner)
    {
      const vtkIdType point = ids->GetId(corner);
      first = std::min(first, sideOf(point));
      last = std::max(last, sideOf(point));
      if (std::find(corners.begin(), corners.end(), point) == corners.end()) // else collapsed
      {
        corners.push_back(point);
      }
    }
    if (first == Front && last == Both && corners.size() > 2)
    {
      return corners;
    }
  }
  return {};
}

/// Returns false if the cells are no layer.
bool flattenCells(const Leaf& leaf, const Sides& sides, const Planes& planes, Remade& made,
  std::vector<Pair>& pairs)
{
  vtkDataSet* data = leaf.data;
  vtkNew<vtkGenericCell> cell;
  const auto placeAt = [&](vtkIdType point) { return planes.onPlane(placeOf(data, point)); };
  const auto sideOf = [&](vtkIdType point) { return sides[static_cast<std::size_t>(point)]; };
  /// Returns the cell's point on the other side of one; the same on both; -1: none.
  const auto opposite = [&](vtkIdType point)
  {
    const Place place = placeAt(point);
    vtkIdType found = -1;
    double least = 100 * planes.tolerance * planes.tolerance;
    for (int i = 0; i < cell->GetNumberOfPoints(); ++i)
    {
      const vtkIdType other = cell->GetPointId(i);
      const double distance = sideOf(other) == -sideOf(point)
        ? vtkMath::Distance2BetweenPoints(place.data(), placeAt(other).data())
        : std::numeric_limits<double>::infinity();
      found = distance <= least ? other : found;
      least = std::min(least, distance);
    }
    return found;
  };
  const auto isOfBoth = [&](vtkIdType point) {
    return sideOf(point) == Both || (opposite(point) < 0 && planes.areOneAt(placeOf(data, point)));
  };
  const auto sideOrBoth = [&](vtkIdType point)
  { return isOfBoth(point) ? static_cast<signed char>(Both) : sideOf(point); };
  std::vector<vtkIdType> numbers(sides.size(), -1);
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  mesh->SetPoints(places);
  mesh->Allocate(data->GetNumberOfCells());
  for (vtkIdType id = 0; id < data->GetNumberOfCells(); ++id)
  {
    if (dimensionOfCell(data, id) != 3)
    {
      continue;
    }
    data->GetCell(id, cell);
    std::vector<vtkIdType> face = frontOf(cell, sideOf);
    face = face.empty() ? frontOf(cell, sideOrBoth) : face; // a point of both planes is behind
    if (face.empty())
    {
      return false;
    }
    for (vtkIdType& corner : face)
    {
      vtkIdType& number = numbers[static_cast<std::size_t>(corner)];
      if (number < 0)
      {
        const vtkIdType other = isOfBoth(corner) ? corner : opposite(corner);
        if (other < 0)
        {
          return false;
        }
        pairs.emplace_back(corner, other);
        number = places->InsertNextPoint(placeAt(corner).data());
        made.points->InsertNextId(corner);
      }
      corner = number;
    }
    const auto count = static_cast<vtkIdType>(face.size());
    mesh->InsertNextCell(
      count == 3 ? VTK_TRIANGLE : (count == 4 ? VTK_QUAD : VTK_POLYGON), count, face.data());
    made.cells->InsertNextId(id);
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

} // namespace

bool isLayerLeaf(const Leaf& leaf) { return dimensionOf(leaf.data) == 3; }

vtkBoundingBox boundsOfLayers(const Flow& flow)
{
  vtkBoundingBox box;
  for (const Leaf& leaf : flow.leaves)
  {
    if (isLayerLeaf(leaf))
    {
      box.AddBounds(leaf.data->GetBounds());
    }
  }
  return box;
}

bool flatten(Flow& flow, const Planes& planes, bool areValuesFree)
{
  std::vector<Leaf> leaves;
  std::vector<vtkSmartPointer<vtkDataSet>> made;
  for (const Leaf& leaf : flow.leaves)
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
  if (flow.image)
  {
    flow.image = vtkImageData::SafeDownCast(leaves.at(0).data);
  }
  flow.leaves = std::move(leaves);
  flow.made.insert(flow.made.end(), made.begin(), made.end());
  return true;
}

} // namespace filters
