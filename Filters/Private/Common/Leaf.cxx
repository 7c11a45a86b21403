// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Leaf.h"

#include "Common/AvailableMemory.h"

#include "vtkDataArrayRange.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

namespace filters
{

vtkSmartPointer<vtkUnsignedCharArray> newMask(vtkIdType count)
{
  auto mask = vtkSmartPointer<vtkUnsignedCharArray>::New();
  mask->SetName(maskName);
  setTuples(mask, count);
  vtkSMPTools::Fill(
    mask->GetPointer(0), mask->GetPointer(0) + count, static_cast<unsigned char>(1));
  return mask;
}

void hidePoints(vtkDataSet* data, vtkUnsignedCharArray* valid)
{
  const vtkIdType count = data->GetNumberOfPoints();
  if (vtkUnsignedCharArray* ghosts = data->GetPointGhostArray())
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (ghosts->GetValue(i) & vtkDataSetAttributes::HIDDENPOINT)
      {
        valid->SetValue(i, 0);
      }
    }
  }
  vtkDataArray* mask = data->GetPointData()->GetArray(maskName);
  if (mask && mask->GetNumberOfComponents() == 1 && mask->GetNumberOfTuples() == count)
  {
    const auto values = vtk::DataArrayValueRange<1>(mask);
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (values[i] == 0)
      {
        valid->SetValue(i, 0);
      }
    }
  }
}

vtkSmartPointer<vtkUnsignedCharArray> visibleOf(const Leaf& leaf)
{
  auto visible =
    newMask(leaf.ofCells ? leaf.data->GetNumberOfCells() : leaf.data->GetNumberOfPoints());
  vtkUnsignedCharArray* ghosts = leaf.ofCells ? leaf.data->GetCellGhostArray() : nullptr;
  for (vtkIdType cell = 0; ghosts && cell < visible->GetNumberOfTuples(); ++cell)
  {
    visible->SetValue(cell, ghosts->GetValue(cell) & hiddenCellBits ? 0 : 1);
  }
  if (!leaf.ofCells)
  {
    hidePoints(leaf.data, visible);
  }
  return visible;
}

} // namespace filters
