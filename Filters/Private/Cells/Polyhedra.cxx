// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/Polyhedra.h"

#include "Cells/CellMeans.h"
#include "Common/CellTypes.h"
#include "Common/Vectors.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <vector>

namespace filters
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Sets the moments of what is inside a cell around a point.
void setMomentsOfCell(
  vtkUnstructuredGrid* mesh, vtkIdType cell, const double point[3], CellsAround& around)
{
  const CellMoments moments = momentsOfPolyhedron(mesh, cell);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double x = moments.middle[i] - point[i];
    around.first[i] = static_cast<float>(x);
    around.second[i] = static_cast<float>(moments.second[i] + x * x);
    const std::size_t next = (i + 1) % 3;
    around.second[i + 3] =
      static_cast<float>(moments.second[i + 3] + x * (moments.middle[next] - point[next]));
  }
}

/// Adds the mean of a cell's corners and of their values, or the cell's own value if known, and over what it is a
/// mean. Returns its number.
vtkIdType addMiddle(vtkUnstructuredGrid* mesh, vtkIdType cell, vtkPoints* points,
  vtkDoubleArray* values, vtkFloatArray* around, bool haveCellsValues)
{
  vtkNew<vtkIdList> ids;
  mesh->GetCellPoints(cell, ids);
  const auto count = static_cast<std::size_t>(ids->GetNumberOfIds());
  std::vector<Vector> corners(count);
  Vector middle = {};
  double value = 0, lowest = infinity, highest = -infinity;
  for (std::size_t i = 0; i < count; ++i)
  {
    const vtkIdType corner = ids->GetId(static_cast<vtkIdType>(i));
    points->GetPoint(corner, corners[i].data());
    middle = middle + (1. / static_cast<double>(count)) * corners[i];
    const double there = values->GetValue(corner);
    value += there / static_cast<double>(count);
    lowest = std::min(lowest, there);
    highest = std::max(highest, there);
  }
  CellsAround own;
  if (haveCellsValues)
  {
    setMomentsOfCell(mesh, cell, middle.data(), own);
    value = mesh->GetCellData()->GetScalars()->GetComponent(cell, 0);
  }
  else
  {
    for (const Vector& corner : corners)
    {
      const Vector x = corner - middle;
      for (std::size_t i = 0; i < 3; ++i)
      {
        own.second[i] += static_cast<float>(x[i] * x[i] / static_cast<double>(count));
        own.second[i + 3] += static_cast<float>(x[i] * x[(i + 1) % 3] / static_cast<double>(count));
      }
    }
    own.lowest = static_cast<float>(lowest - value);
    own.highest = static_cast<float>(highest - value);
  }
  around->InsertNextTypedTuple(own.first); // including its other members
  values->InsertNextValue(value);
  return points->InsertNextPoint(middle.data());
}

/// Returns the corners of each end of a prism that VTK locates wrongly; 0: another cell.
int cornersOfPrism(int type)
{
  return type == VTK_PENTAGONAL_PRISM ? 5 : type == VTK_HEXAGONAL_PRISM ? 6 : 0;
}

/// Returns whether there is a cell of such a type. VTK would compute a list of distinct types for each dataset.
template <class IsSuch>
bool hasAny(vtkDataSet* data, const IsSuch& isSuch)
{
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(data);
  auto* types = mesh ? vtkUnsignedCharArray::SafeDownCast(cellTypesOf(mesh)) : nullptr;
  const unsigned char* first = types ? types->GetPointer(0) : nullptr;
  return std::any_of(first, first + (types ? types->GetNumberOfValues() : 0), isSuch);
}

/// Cuts a prism with so many corners at each end from its lowest one, by add(type, corners).
template <class Add>
void cutPrism(const vtkIdType* low, int count, const Add& add)
{
  const vtkIdType* high = low + count;
  const auto first = static_cast<int>(std::min_element(low, high) - low);
  for (int i = 1; i + 1 < count; ++i)
  {
    const int second = (first + i) % count, third = (first + i + 1) % count;
    add(VTK_WEDGE, { low[first], low[second], low[third], high[first], high[second], high[third] });
  }
}

/// Joins a polyhedron's faces with its middle: those with four corners as they are, triangles of others. `faces`: for
/// each face the number of points, and the points.
template <class Add>
void cutPolyhedron(vtkIdList* faces, vtkIdType middle, const Add& add)
{
  vtkIdType at = 1;
  for (vtkIdType face = 0; face < faces->GetId(0); ++face)
  {
    const vtkIdType count = faces->GetId(at++);
    const vtkIdType* corners = faces->GetPointer(at);
    at += count;
    if (count == 4)
    {
      add(VTK_PYRAMID, { corners[0], corners[1], corners[2], corners[3], middle });
      continue;
    }
    const vtkIdType first = std::min_element(corners, corners + count) - corners;
    for (vtkIdType i = 1; i + 1 < count; ++i)
    {
      add(VTK_TETRA,
        { corners[first], corners[(first + i) % count], corners[(first + i + 1) % count], middle });
    }
  }
}

} // namespace

bool hasPolyhedra(vtkDataSet* data)
{
  return hasAny(data, [](int type) { return type == VTK_POLYHEDRON; });
}

vtkSmartPointer<vtkDataSet> withoutPolyhedra(vtkDataSet* data)
{
  const bool areThere = hasPolyhedra(data);
  if (!areThere && !hasAny(data, [](int type) { return cornersOfPrism(type) > 0; }))
  {
    return data;
  }
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(data);

  vtkUnsignedCharArray* ghosts = mesh->GetCellGhostArray();
  auto* scalars = vtkDoubleArray::SafeDownCast(mesh->GetPointData()->GetScalars());
  auto cut = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->DeepCopy(mesh->GetPoints());
  vtkNew<vtkDoubleArray> values;
  values->DeepCopy(scalars);
  auto* aroundPoints = vtkFloatArray::SafeDownCast(mesh->GetPointData()->GetArray(cellsAroundName));
  vtkSmartPointer<vtkFloatArray> around;
  if (aroundPoints)
  {
    around = vtkSmartPointer<vtkFloatArray>::New();
    around->DeepCopy(aroundPoints);
  }
  else if (areThere)
  {
    around = vtkFloatArray::SafeDownCast(
      arrayOf(std::vector<CellsAround>(static_cast<std::size_t>(mesh->GetNumberOfPoints()))));
  }
  vtkNew<vtkUnsignedCharArray> kept;
  kept->SetName(vtkDataSetAttributes::GhostArrayName());
  cut->Allocate(mesh->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    const unsigned char ghost = ghosts ? ghosts->GetValue(cell) : 0;
    const int type = mesh->GetCellType(cell);
    const auto add = [&](int ofPart, std::initializer_list<vtkIdType> corners)
    {
      cut->InsertNextCell(ofPart, static_cast<vtkIdType>(corners.size()), corners.begin());
      kept->InsertNextValue(ghost);
    };
    if (type == VTK_POLYHEDRON)
    {
      const vtkIdType middle =
        addMiddle(mesh, cell, points, values, around, aroundPoints != nullptr);
      mesh->GetFaceStream(cell, ids);
      cutPolyhedron(ids, middle, add);
      continue;
    }
    mesh->GetCellPoints(cell, ids);
    if (const int count = cornersOfPrism(type))
    {
      cutPrism(ids->GetPointer(0), count, add);
      continue;
    }
    cut->InsertNextCell(type, ids);
    kept->InsertNextValue(ghost);
  }
  cut->SetPoints(points);
  cut->GetPointData()->SetScalars(values);
  if (around)
  {
    cut->GetPointData()->AddArray(around);
  }
  cut->GetCellData()->AddArray(kept);
  return cut;
}

} // namespace filters
