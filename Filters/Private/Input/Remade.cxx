// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/Remade.h"

#include "Common/AvailableMemory.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

namespace filters
{

vtkSmartPointer<vtkDataArray> chosenValues(vtkDataArray* from, vtkIdList* ids)
{
  auto to = vtkSmartPointer<vtkDataArray>::Take(from->NewInstance());
  to->SetName(from->GetName());
  to->SetNumberOfComponents(from->GetNumberOfComponents());
  setTuples(to, ids->GetNumberOfIds());
  from->GetTuples(ids, to);
  return to;
}

Leaf Remade::leafOf(const Leaf& from) const
{
  Leaf one{ this->data, {}, from.ofCells, from.input };
  for (vtkDataArray* array : from.arrays)
  {
    const auto values = chosenValues(array, from.ofCells ? this->cells : this->points);
    one.data->GetAttributes(from.ofCells ? vtkDataObject::CELL : vtkDataObject::POINT)
      ->AddArray(values);
    one.arrays.push_back(values);
  }
  if (vtkUnsignedCharArray* ghosts = from.data->GetCellGhostArray())
  {
    one.data->GetCellData()->AddArray(chosenValues(ghosts, this->cells));
  }
  for (const char* name : { vtkDataSetAttributes::GhostArrayName(), maskName, transparentName })
  {
    vtkDataArray* flags = from.data->GetPointData()->GetArray(name);
    if (flags && !one.data->GetPointData()->HasArray(name))
    {
      one.data->GetPointData()->AddArray(chosenValues(flags, this->points));
    }
  }
  return one;
}

} // namespace filters
