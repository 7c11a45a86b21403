// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/Mask.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace filters
{

vtkSmartPointer<vtkDataSet> hideMasked(const Leaf& leaf, const Mask& mask)
{
  vtkDataSet* data = leaf.data;
  const bool hidesCells = mask.ofCells || leaf.ofCells;
  const vtkIdType count = hidesCells ? data->GetNumberOfCells() : data->GetNumberOfPoints();
  const int hidden =
    hidesCells ? int{ vtkDataSetAttributes::HIDDENCELL } : int{ vtkDataSetAttributes::HIDDENPOINT };
  vtkUnsignedCharArray* before =
    hidesCells ? data->GetCellGhostArray() : data->GetPointGhostArray();
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(count);
  vtkNew<vtkIdList> points;
  for (vtkIdType i = 0; i < count; ++i)
  {
    bool isHidden = false;
    if (hidesCells && !mask.ofCells)
    {
      data->GetCellPoints(i, points);
      isHidden = std::any_of(points->begin(), points->end(),
        [&](vtkIdType point) { return mask.hides(mask.values->GetComponent(point, 0)); });
    }
    else
    {
      isHidden = mask.hides(mask.values->GetComponent(i, 0));
    }
    const unsigned char own = before ? before->GetValue(i) : 0;
    ghosts->SetValue(i, static_cast<unsigned char>(isHidden ? own | hidden : own));
  }
  auto copy = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
  copy->ShallowCopy(data);
  copy->GetAttributes(hidesCells ? vtkDataObject::CELL : vtkDataObject::POINT)->AddArray(ghosts);
  return copy;
}

} // namespace filters
