// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sources/Mirrored.h"

#include "Input/FlatData.h"

#include "vtkCell.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace filters
{

namespace
{

/// Mirrors an image at the axis.
vtkSmartPointer<vtkImageData> turnedOver(
  vtkImageData* image, const Revolution& revolution, Remade& made)
{
  const int radial = revolution.radial;
  int points[3], cells[3];
  image->GetDimensions(points);
  for (int axis = 0; axis < 3; ++axis)
  {
    cells[axis] = std::max(1, points[axis] - 1);
  }
  double origin[3], spacing[3], bounds[6];
  image->GetOrigin(origin);
  image->GetSpacing(spacing);
  image->GetBounds(bounds);
  auto other = vtkSmartPointer<vtkImageData>::New();
  double corner[3] = { bounds[0], bounds[2], bounds[4] };
  corner[radial] = 2 * revolution.origin[static_cast<std::size_t>(radial)] - bounds[2 * radial + 1];
  other->SetDimensions(points);
  other->SetOrigin(corner);
  other->SetSpacing(spacing);
  const auto collect = [radial](const int count[3], vtkIdType ofAll, vtkIdList* ids)
  {
    const vtkIdType stride = radial == 0 ? 1 : vtkIdType{ count[0] } * (radial == 1 ? 1 : count[1]);
    for (vtkIdType id = 0; id < ofAll; ++id)
    {
      const vtkIdType place = id / stride % count[radial];
      ids->InsertNextId(id + (count[radial] - 1 - 2 * place) * stride);
    }
  };
  collect(points, image->GetNumberOfPoints(), made.points);
  collect(cells, image->GetNumberOfCells(), made.cells);
  return other;
}

/// Finds rows of points about half a cell from the axis: structured data without points on it.
/// Returns each point and its neighbour in the row's cells, in order; empty: there are none.
std::vector<std::array<vtkIdType, 2>> rowAtAxis(vtkDataSet* data, const Revolution& revolution)
{
  constexpr double widest = 0.75; // cells
  const std::array<int, 3> points = structureOf(data);
  const auto radial = static_cast<std::size_t>(revolution.radial);
  const double from = revolution.origin[radial];
  std::vector<std::array<vtkIdType, 2>> row;
  std::array<vtkIdType, 3> strides{ 1, points[0], vtkIdType{ points[0] } * points[1] };
  for (std::size_t away = 0; away < 3; ++away)
  {
    for (std::size_t along = 0; along < 3; ++along)
    {
      if (away == along || points[away] < 2 || points[along] < 2)
      {
        continue;
      }
      for (const bool isLast : { false, true })
      {
        const vtkIdType first = isLast ? (points[away] - 1) * strides[away] : 0;
        const vtkIdType inward = isLast ? -strides[away] : strides[away];
        bool isRow = true;
        for (int i = 0; i < points[along] && isRow; ++i)
        {
          double x[3], next[3];
          data->GetPoint(first + i * strides[along], x);
          data->GetPoint(first + i * strides[along] + inward, next);
          const double r = std::abs(x[radial] - from);
          isRow = r > revolution.tolerance && r <= widest * std::abs(next[radial] - x[radial]);
        }
        for (int i = 0; i + 1 < points[along] && isRow; ++i)
        {
          row.push_back({ first + i * strides[along], first + (i + 1) * strides[along] });
        }
        if (isRow)
        {
          return row;
        }
      }
    }
  }
  return row;
}

/// Returns twice the area of a polygon in the plane; negative for the other orientation.
double areaOf(
  vtkPoints* places, const std::vector<vtkIdType>& corners, const Revolution& revolution)
{
  const auto along = static_cast<std::size_t>(revolution.axis),
             away = static_cast<std::size_t>(revolution.radial);
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    std::array<double, 3> a, b;
    places->GetPoint(corners[i], a.data());
    places->GetPoint(corners[(i + 1) % corners.size()], b.data());
    area += a[along] * b[away] - a[away] * b[along];
  }
  return area;
}

/// Adds the points and their images across the axis. Returns those of each point: itself on the axis.
std::vector<vtkIdType> addPointsOfBothSides(
  vtkDataSet* data, const Revolution& revolution, vtkPoints* places, Remade& made)
{
  const auto radial = static_cast<std::size_t>(revolution.radial);
  const double from = revolution.origin[radial];
  std::vector<vtkIdType> others(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (const bool isOther : { false, true })
  {
    for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
    {
      std::array<double, 3> x;
      data->GetPoint(point, x.data());
      const bool isOnAxis = std::abs(x[radial] - from) <= revolution.tolerance;
      if (!isOther || !isOnAxis)
      {
        x[radial] = isOnAxis ? from : (isOther ? 2 * from - x[radial] : x[radial]);
        others[static_cast<std::size_t>(point)] = places->InsertNextPoint(x.data());
        made.points->InsertNextId(point);
      }
    }
  }
  return others;
}

/// Finds the corners of a plane cell, or of the triangles that it is divided into. Returns the type of these.
int cornersOfPlane(vtkDataSet* data, vtkIdType cell, vtkIdList* ids)
{
  const int type = data->GetCellType(cell);
  data->GetCellPoints(cell, ids);
  if (type == VTK_PIXEL)
  {
    const vtkIdType last = ids->GetId(3);
    ids->SetId(3, ids->GetId(2));
    ids->SetId(2, last);
    return VTK_QUAD;
  }
  if (type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_POLYGON)
  {
    return type;
  }
  vtkNew<vtkPoints> notUsed;
  data->GetCell(cell)->Triangulate(0, ids, notUsed);
  return VTK_TRIANGLE;
}

/// Makes a mesh of both sides of the axis, with points on it once. (vtkReflectionFilter has points
/// in single precision, and twice those on the axis.)
void addBothSides(const Leaf& leaf, const Revolution& revolution, Remade& made)
{
  vtkDataSet* data = leaf.data;
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  const std::vector<vtkIdType> others = addPointsOfBothSides(data, revolution, places, made);
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  mesh->SetPoints(places);
  mesh->Allocate(2 * data->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  double area = 0; // of the first cell
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    if (dimensionOfCell(data, cell) != 2)
    {
      continue;
    }
    const int type = cornersOfPlane(data, cell, ids);
    const vtkIdType size = type == VTK_TRIANGLE ? 3 : ids->GetNumberOfIds();
    for (vtkIdType begin = 0; begin + size <= ids->GetNumberOfIds(); begin += size)
    {
      const std::vector<vtkIdType> corners(ids->GetPointer(begin), ids->GetPointer(begin) + size);
      area = area != 0 ? area : areaOf(places, corners, revolution);
      mesh->InsertNextCell(type, size, corners.data());
      made.cells->InsertNextId(cell);
      std::vector<vtkIdType> turned(corners.rbegin(), corners.rend());
      for (vtkIdType& corner : turned)
      {
        corner = others[static_cast<std::size_t>(corner)];
      }
      mesh->InsertNextCell(type, size, turned.data());
      made.cells->InsertNextId(cell);
    }
  }
  if (!leaf.ofCells) // cells have no values nearer to the axis
  {
    for (const std::array<vtkIdType, 2>& side : rowAtAxis(data, revolution))
    {
      std::vector<vtkIdType> corners{ side[0], side[1], others[static_cast<std::size_t>(side[1])],
        others[static_cast<std::size_t>(side[0])] };
      if (areaOf(places, corners, revolution) * area < 0)
      {
        std::reverse(corners.begin(), corners.end());
      }
      mesh->InsertNextCell(VTK_QUAD, 4, corners.data());
      made.cells->InsertNextId(0);
    }
  }
  made.data = mesh;
}

} // namespace

Flow mirrored(const Flow& flow, const Revolution& revolution)
{
  Flow result = flow;
  result.image = nullptr; // an ordinary leaf
  if (!revolution.isMirrored)
  {
    return result;
  }
  result.leaves.clear();
  for (const Leaf& leaf : flow.leaves)
  {
    Remade made;
    auto* image = vtkImageData::SafeDownCast(leaf.data);
    if (image && leaf.ofCells)
    {
      result.leaves.push_back(leaf);
      made.data = turnedOver(image, revolution, made);
    }
    else
    {
      addBothSides(leaf, revolution, made);
    }
    result.leaves.push_back(made.leafOf(leaf));
    result.made.emplace_back(made.data);
  }
  return result;
}

} // namespace filters
