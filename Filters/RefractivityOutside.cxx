// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityOutside.h"

#include "RefractivityValues.h"

#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filters
{

namespace
{

vtkSmartPointer<vtkUnsignedCharArray> newOutside(vtkIdType count)
{
  auto outside = newMask(count);
  outside->SetName(transparentName);
  return outside;
}

} // namespace

vtkSmartPointer<vtkUnsignedCharArray> outsideOfBoxes(
  const std::vector<Leaf>& leaves, vtkImageData* grid)
{
  auto outside = newOutside(grid->GetNumberOfPoints());
  const int* points = grid->GetDimensions();
  for (const Leaf& leaf : leaves)
  {
    const double* bounds = leaf.data->GetBounds();
    std::array<int, 3> first, last;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double low = bounds[2 * axis], high = bounds[2 * axis + 1];
      const double most = points[axis] - 1;
      const auto indexOf = [&](double x)
      { return (x - grid->GetOrigin()[axis]) / grid->GetSpacing()[axis]; };
      first[axis] =
        low < high ? static_cast<int>(std::clamp(std::ceil(indexOf(low)), 0., most + 1)) : 0;
      last[axis] =
        static_cast<int>(low < high ? std::clamp(std::floor(indexOf(high)), -1., most) : most);
    }
    for (int k = first[2]; k <= last[2]; ++k)
    {
      for (int j = first[1]; j <= last[1]; ++j)
      {
        const vtkIdType row = (static_cast<vtkIdType>(k) * points[1] + j) * points[0];
        for (int i = first[0]; i <= last[0]; ++i)
        {
          outside->SetValue(row + i, 0);
        }
      }
    }
  }
  return outside;
}

vtkSmartPointer<vtkUnsignedCharArray> outsideFrom(vtkDataSet* image)
{
  vtkDataArray* given = image->GetPointData()->GetArray(transparentName);
  if (!given || given->GetNumberOfComponents() != 1 ||
    given->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    return nullptr;
  }
  vtkUnsignedCharArray* ghosts = image->GetPointGhostArray();
  auto outside = newOutside(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < outside->GetNumberOfValues(); ++i)
  {
    const bool isHidden = ghosts && (ghosts->GetValue(i) & vtkDataSetAttributes::HIDDENPOINT);
    outside->SetValue(i, given->GetComponent(i, 0) != 0 && !isHidden ? 1 : 0);
  }
  return outside;
}

void setOutside(vtkUnsignedCharArray* outside, vtkImageData* output)
{
  vtkDataArray* valid = output->GetPointData()->GetArray(maskName);
  for (vtkIdType i = 0; i < outside->GetNumberOfValues(); ++i)
  {
    if (valid->GetComponent(i, 0) != 0)
    {
      outside->SetValue(i, 0);
    }
  }
  output->GetPointData()->AddArray(outside);
}

} // namespace filters
