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

} // namespace

vtkSmartPointer<vtkDataSet> withoutPolyhedra(vtkDataSet* data)
{
  // Avoids the list of distinct types, which VTK computes for each dataset.
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(data);
  bool hasAny = false;
  if (auto* types = vtkUnsignedCharArray::SafeDownCast(mesh ? cellTypesOf(mesh) : nullptr))
  {
    const unsigned char* first = types->GetPointer(0);
    const unsigned char* end = first + types->GetNumberOfValues();
    hasAny = std::any_of(first, end, isCut);
  }
  else
  {
    for (vtkIdType cell = 0; mesh && !hasAny && cell < mesh->GetNumberOfCells(); ++cell)
    {
      hasAny = isCut(mesh->GetCellType(cell));
    }
  }
  if (!hasAny)
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
    if (const int count = cornersOfPrism(type))
    {
      mesh->GetCellPoints(cell, ids);
      const vtkIdType* low = ids->GetPointer(0);
      const vtkIdType* high = low + count;
      const auto first = static_cast<int>(std::min_element(low, high) - low);
      for (int i = 1; i + 1 < count; ++i)
      {
        const int second = (first + i) % count, third = (first + i + 1) % count;
        const vtkIdType wedge[6] = { low[first], low[second], low[third], high[first], high[second],
          high[third] };
        cut->InsertNextCell(VTK_WEDGE, 6, wedge);
        kept->InsertNextValue(ghost);
      }
      continue;
    }
    if (type != VTK_POLYHEDRON)
    {
      mesh->GetCellPoints(cell, ids);
      cut->InsertNextCell(type, ids);
      kept->InsertNextValue(ghost);
      continue;
    }
    const vtkIdType middle = addMiddle(mesh, cell, points, values, around);
    mesh->GetFaceStream(cell, ids); // for each face the number of points, and the points
    vtkIdType at = 1;
    for (vtkIdType face = 0; face < ids->GetId(0); ++face)
    {
      const vtkIdType count = ids->GetId(at++);
      const vtkIdType* corners = ids->GetPointer(at);
      at += count;
      const vtkIdType first = std::min_element(corners, corners + count) - corners;
      for (vtkIdType i = 1; i + 1 < count; ++i)
      {
        const vtkIdType tetrahedron[4] = { corners[first], corners[(first + i) % count],
          corners[(first + i + 1) % count], middle };
        cut->InsertNextCell(VTK_TETRA, 4, tetrahedron);
        kept->InsertNextValue(ghost);
      }
    }
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
