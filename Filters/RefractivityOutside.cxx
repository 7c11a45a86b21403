// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityOutside.h"

#include "RefractivityValues.h"

#include "LocalResampler.h"
#include "vtkCellData.h"
#include "vtkCellTypes.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace refractivity
{

namespace
{

bool isHidden(vtkDataSet* data, vtkIdType cell, int dimension)
{
  return (data->GetCellGhostArray()->GetValue(cell) & hiddenCellBits) != 0 &&
    vtkCellTypes::GetDimension(static_cast<unsigned char>(data->GetCellType(cell))) == dimension;
}

/// A copy of which only the hidden cells of this dimension are visible; null where there are none.
vtkSmartPointer<vtkDataSet> onlyHiddenOf(vtkDataSet* data, int dimension)
{
  const vtkIdType cells = data->GetNumberOfCells();
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(cells);
  bool hasSome = false;
  for (vtkIdType i = 0; i < cells; ++i)
  {
    const bool hidden = isHidden(data, i, dimension);
    ghosts->SetValue(i, hidden ? 0 : vtkDataSetAttributes::HIDDENCELL);
    hasSome = hasSome || hidden;
  }
  if (!hasSome)
  {
    return nullptr;
  }
  auto copy = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
  copy->CopyStructure(data);
  copy->GetPointData()->ShallowCopy(data->GetPointData()); // the sampler wants an array
  copy->GetCellData()->AddArray(ghosts);
  return copy;
}

vtkSmartPointer<vtkUnsignedCharArray> newOutside(vtkIdType count)
{
  auto outside = newMask(count);
  outside->SetName(transparentName);
  return outside;
}

} // namespace

vtkSmartPointer<vtkUnsignedCharArray> outsideOf(
  vtkMultiBlockDataSet* blocks, int dimension, vtkImageData* grid, vtkUnsignedCharArray* visible)
{
  auto outside = newOutside(grid->GetNumberOfPoints());
  for (vtkIdType i = 0; i < outside->GetNumberOfValues(); ++i)
  {
    outside->SetValue(i, visible->GetValue(i) ? 0 : 1);
  }
  vtkNew<vtkMultiBlockDataSet> hidden;
  for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
  {
    if (const auto some = onlyHiddenOf(vtkDataSet::SafeDownCast(blocks->GetBlock(i)), dimension))
    {
      hidden->SetBlock(hidden->GetNumberOfBlocks(), some);
    }
  }
  if (hidden->GetNumberOfBlocks() > 0)
  {
    vtkNew<LocalResampler> resampler;
    resampler->SetInputDataObject(hidden);
    resampler->UseInputBoundsOff();
    resampler->SetSamplingBounds(grid->GetBounds());
    resampler->SetSamplingDimensions(grid->GetDimensions());
    resampler->Update();
    auto covered = newMask(grid->GetNumberOfPoints());
    hidePoints(resampler->GetOutput(), covered);
    for (vtkIdType i = 0; i < outside->GetNumberOfValues(); ++i)
    {
      outside->SetValue(i, covered->GetValue(i) ? 0 : outside->GetValue(i));
    }
  }
  return outside;
}

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

} // namespace refractivity
