// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/Polyhedra.h"

#include "Cells/CellMeans.h"
#include "Common/CellTypes.h"

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

namespace filters
{

namespace
{

/// Adds the mean of a cell's corners and of their values, or the cell's own value if known. Returns
/// its number.
vtkIdType addMiddle(vtkUnstructuredGrid* mesh, vtkIdType cell, vtkPoints* points,
  vtkDoubleArray* values, vtkFloatArray* around)
{
  vtkNew<vtkIdList> corners;
  mesh->GetCellPoints(cell, corners);
  const auto count = static_cast<double>(corners->GetNumberOfIds());
  double middle[3] = { 0, 0, 0 }, value = 0;
  for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
  {
    double corner[3];
    points->GetPoint(corners->GetId(i), corner);
    for (int axis = 0; axis < 3; ++axis)
    {
      middle[axis] += corner[axis] / count;
    }
    value += values->GetValue(corners->GetId(i)) / count;
  }
  if (around)
  {
    const CellMoments moments = momentsOfPolyhedron(mesh, cell);
    CellsAround own;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const double x = moments.middle[i] - middle[i];
      own.first[i] = static_cast<float>(x);
      own.second[i] = static_cast<float>(moments.second[i] + x * x);
      const std::size_t next = (i + 1) % 3;
      own.second[i + 3] =
        static_cast<float>(moments.second[i + 3] + x * (moments.middle[next] - middle[next]));
    }
    around->InsertNextTypedTuple(own.first); // including its other members
    value = mesh->GetCellData()->GetScalars()->GetComponent(cell, 0);
  }
  values->InsertNextValue(value);
  return points->InsertNextPoint(middle);
}

/// Returns the corners of each end of a prism that VTK locates wrongly; 0: another cell.
int cornersOfPrism(int type)
{
  return type == VTK_PENTAGONAL_PRISM ? 5 : type == VTK_HEXAGONAL_PRISM ? 6 : 0;
}

bool isCut(int type) { return type == VTK_POLYHEDRON || cornersOfPrism(type) > 0; }

/// Returns whether there is a cell to cut. VTK would compute a list of distinct types for each dataset.
bool hasAnyToCut(vtkUnstructuredGrid* mesh)
{
  auto* types = vtkUnsignedCharArray::SafeDownCast(cellTypesOf(mesh));
  const unsigned char* first = types ? types->GetPointer(0) : nullptr;
  return std::any_of(first, first + (types ? types->GetNumberOfValues() : 0), isCut);
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

/// Joins triangles of a polyhedron's faces with its middle. `faces`: for each face the number of points, and the points.
template <class Add>
void cutPolyhedron(vtkIdList* faces, vtkIdType middle, const Add& add)
{
  vtkIdType at = 1;
  for (vtkIdType face = 0; face < faces->GetId(0); ++face)
  {
    const vtkIdType count = faces->GetId(at++);
    const vtkIdType* corners = faces->GetPointer(at);
    at += count;
    const vtkIdType first = std::min_element(corners, corners + count) - corners;
    for (vtkIdType i = 1; i + 1 < count; ++i)
    {
      add(VTK_TETRA,
        { corners[first], corners[(first + i) % count], corners[(first + i + 1) % count], middle });
    }
  }
}

} // namespace

vtkSmartPointer<vtkDataSet> withoutPolyhedra(vtkDataSet* data)
{
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(data);
  if (!mesh || !hasAnyToCut(mesh))
  {
    return data;
  }

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
      const vtkIdType middle = addMiddle(mesh, cell, points, values, around);
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
