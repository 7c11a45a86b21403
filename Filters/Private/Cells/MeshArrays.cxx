// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/MeshArrays.h"

#include "Cells/CellMeans.h"
#include "Common/CellTypes.h"
#include "Common/Leaf.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>

namespace filters
{

namespace
{

/// Returns null for arrays of other types.
template <class Number>
const Number* numbersOf(vtkDataArray* array)
{
  auto* numbers = vtkAOSDataArrayTemplate<Number>::FastDownCast(array);
  return numbers ? numbers->GetPointer(0) : nullptr;
}

} // namespace

MeshArrays::MeshArrays(vtkDataSet* data)
  : Data(data)
  , CellCount(data->GetNumberOfCells())
  , PointCount(data->GetNumberOfPoints())
{
  this->Values = numbersOf<double>(data->GetPointData()->GetScalars());
  if (const float* around = numbersOf<float>(data->GetPointData()->GetArray(cellsAroundName)))
  {
    this->Around = reinterpret_cast<const CellsAround*>(around); // written by arrayOf()
  }
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  this->Ghosts = ghosts ? ghosts->GetPointer(0) : nullptr;
  this->setPoints();
  this->setCells();
}

void MeshArrays::setValues(std::vector<double> values)
{
  this->OwnValues = std::move(values);
  this->Values = this->OwnValues.data();
  this->Around = nullptr;
}

bool MeshArrays::isVisible(vtkIdType cell) const
{
  return !this->Ghosts || (this->Ghosts[cell] & hiddenCellBits) == 0;
}

bool MeshArrays::isCopy(vtkIdType cell) const
{
  return this->Ghosts && (this->Ghosts[cell] & vtkDataSetAttributes::DUPLICATECELL) != 0;
}

std::size_t MeshArrays::bytes() const
{
  return this->OwnPoints.size() * sizeof(double) + this->OwnTypes.size() +
    (this->OwnOffsets.size() + this->OwnCells.size()) * sizeof(vtkTypeInt64) +
    this->Trends.size() * sizeof(PointTrend) + this->OwnValues.size() * sizeof(double);
}

std::vector<int> MeshArrays::types() const
{
  if (!this->Types)
  {
    return { this->Type };
  }
  std::array<bool, 256> exists{};
  for (vtkIdType i = 0; i < this->CellCount; ++i)
  {
    exists[this->Types[i]] = true;
  }
  std::vector<int> types;
  for (int type = 0; type < 256; ++type)
  {
    if (exists[static_cast<std::size_t>(type)])
    {
      types.push_back(type);
    }
  }
  return types;
}

void MeshArrays::setPoints()
{
  auto* set = vtkPointSet::SafeDownCast(this->Data);
  if (set && set->GetPoints())
  {
    this->Floats = numbersOf<float>(set->GetPoints()->GetData());
    this->Doubles = numbersOf<double>(set->GetPoints()->GetData());
  }
  if (!this->Floats && !this->Doubles)
  {
    this->OwnPoints.resize(3 * static_cast<std::size_t>(this->PointCount) + 3);
    this->Doubles = this->OwnPoints.data();
    for (vtkIdType i = 0; i < this->PointCount; ++i)
    {
      this->Data->GetPoint(i, this->OwnPoints.data() + 3 * i);
    }
  }
}

void MeshArrays::setCells()
{
  // Reads hidden cells from the ghost array instead of from their types, which would be empty.
  const std::array<int, 3> dimensions = structureOf(this->Data);
  if (*std::min_element(dimensions.begin(), dimensions.end()) > 1)
  {
    this->IsVoxel = vtkStructuredGrid::SafeDownCast(this->Data) == nullptr;
    this->Type = this->IsVoxel ? VTK_VOXEL : VTK_HEXAHEDRON;
    this->CellsAlong = dimensions[0] - 1;
    this->CellsAcross = dimensions[1] - 1;
    this->Row = dimensions[0];
    this->Layer = this->Row * dimensions[1];
    return;
  }
  if (auto* mesh = vtkUnstructuredGrid::SafeDownCast(this->Data))
  {
    this->Types = numbersOf<unsigned char>(cellTypesOf(mesh));
    vtkCellArray* cells = mesh->GetCells();
    if (cells && cells->IsStorage64Bit())
    {
      this->Offsets64 = numbersOf<vtkTypeInt64>(cells->GetOffsetsArray());
      this->Points64 = numbersOf<vtkTypeInt64>(cells->GetConnectivityArray());
    }
    else if (cells)
    {
      this->Offsets32 = numbersOf<vtkTypeInt32>(cells->GetOffsetsArray());
      this->Points32 = numbersOf<vtkTypeInt32>(cells->GetConnectivityArray());
    }
  }
  if (!this->Types)
  {
    this->OwnTypes.resize(static_cast<std::size_t>(this->CellCount) + 1); // never empty
    for (vtkIdType i = 0; i < this->CellCount; ++i)
    {
      this->OwnTypes[static_cast<std::size_t>(i)] =
        static_cast<unsigned char>(this->Data->GetCellType(i));
    }
    this->Types = this->OwnTypes.data();
  }
  if (!(this->Offsets64 && this->Points64) && !(this->Offsets32 && this->Points32))
  {
    this->copyCells();
  }
}

void MeshArrays::copyCells()
{
  this->OwnOffsets.assign(1, 0);
  vtkNew<vtkIdList> points;
  for (vtkIdType i = 0; i < this->CellCount; ++i)
  {
    this->Data->GetCellPoints(i, points);
    for (vtkIdType k = 0; k < points->GetNumberOfIds(); ++k)
    {
      this->OwnCells.push_back(points->GetId(k));
    }
    this->OwnOffsets.push_back(static_cast<vtkTypeInt64>(this->OwnCells.size()));
  }
  this->OwnCells.push_back(0); // never empty
  this->Offsets64 = this->OwnOffsets.data();
  this->Points64 = this->OwnCells.data();
}

} // namespace filters
