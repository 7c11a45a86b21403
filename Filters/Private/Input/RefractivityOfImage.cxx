// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Input/RefractivityOfImage.h"

#include "Input/FlatData.h"
#include "Input/RefractivityValues.h"
#include "NumberText.h"

#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace filters
{

namespace
{

/// Calls visit(cell, eight corners) for all cells; corners coincide in a flat image.
template <class Visit>
void forCells(vtkImageData* image, const Visit& visit)
{
  int points[3];
  image->GetDimensions(points);
  const vtkIdType dx = points[0] > 1 ? 1 : 0;
  const vtkIdType dy = points[1] > 1 ? points[0] : 0;
  const vtkIdType dz = points[2] > 1 ? static_cast<vtkIdType>(points[0]) * points[1] : 0;
  vtkIdType cell = 0;
  for (int k = 0; k < std::max(points[2] - 1, 1); ++k)
  {
    for (int j = 0; j < std::max(points[1] - 1, 1); ++j)
    {
      for (int i = 0; i < std::max(points[0] - 1, 1); ++i)
      {
        const vtkIdType p = k * dz + j * dy + i * dx;
        visit(cell++,
          std::array<vtkIdType, 8>{
            p, p + dx, p + dy, p + dx + dy, p + dz, p + dx + dz, p + dy + dz, p + dx + dy + dz });
      }
    }
  }
}

/// Hides points whose cells are all hidden (a body of m cells loses m - 1 points), and all points
/// of hidden cells that still have no hidden point, so that thin bodies do not vanish.
void hidePointsOfHiddenCells(vtkImageData* image, vtkUnsignedCharArray* valid)
{
  vtkUnsignedCharArray* ghosts = image->GetCellGhostArray();
  if (!ghosts || image->GetDataDimension() < 2)
  {
    return;
  }
  const auto isHidden = [ghosts](vtkIdType cell)
  { return (ghosts->GetValue(cell) & hiddenCellBits) != 0; };

  std::vector<bool> seen(static_cast<std::size_t>(image->GetNumberOfPoints()), false);
  forCells(image,
    [&](vtkIdType cell, const std::array<vtkIdType, 8>& corners)
    {
      if (!isHidden(cell))
      {
        for (const vtkIdType corner : corners)
        {
          seen[static_cast<std::size_t>(corner)] = true;
        }
      }
    });
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    if (!seen[static_cast<std::size_t>(i)])
    {
      valid->SetValue(i, 0);
    }
  }

  std::vector<vtkIdType> thin;
  forCells(image,
    [&](vtkIdType cell, const std::array<vtkIdType, 8>& corners)
    {
      if (isHidden(cell) &&
        std::all_of(corners.begin(), corners.end(),
          [&](vtkIdType corner) { return valid->GetValue(corner) != 0; }))
      {
        thin.insert(thin.end(), corners.begin(), corners.end());
      }
    });
  for (const vtkIdType point : thin)
  {
    valid->SetValue(point, 0);
  }
}

/// Hides hidden cells, and cells with a hidden point.
void hideCells(vtkImageData* image, vtkUnsignedCharArray* valid)
{
  if (vtkUnsignedCharArray* ghosts = image->GetCellGhostArray())
  {
    for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
    {
      if (ghosts->GetValue(i) & hiddenCellBits)
      {
        valid->SetValue(i, 0);
      }
    }
  }
  vtkUnsignedCharArray* ghosts = image->GetPointGhostArray();
  if (!ghosts || image->GetDataDimension() < 2)
  {
    return;
  }
  forCells(image,
    [&](vtkIdType cell, const std::array<vtkIdType, 8>& corners)
    {
      if (std::any_of(corners.begin(), corners.end(),
            [&](vtkIdType corner)
            { return (ghosts->GetValue(corner) & vtkDataSetAttributes::HIDDENPOINT) != 0; }))
      {
        valid->SetValue(cell, 0);
      }
    });
}

/// Returns whether the image may have hidden points or cells.
bool hidesSome(vtkImageData* image)
{
  return image->GetPointGhostArray() || image->GetCellGhostArray() ||
    image->GetPointData()->HasArray(maskName);
}

/// Returns the array of points that let light pass; null if the image has none.
vtkSmartPointer<vtkUnsignedCharArray> outsideFrom(vtkDataSet* image)
{
  vtkDataArray* given = image->GetPointData()->GetArray(transparentName);
  if (!given || given->GetNumberOfComponents() != 1 ||
    given->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    return nullptr;
  }
  vtkUnsignedCharArray* ghosts = image->GetPointGhostArray();
  auto outside = newMask(image->GetNumberOfPoints());
  outside->SetName(transparentName);
  for (vtkIdType i = 0; i < outside->GetNumberOfValues(); ++i)
  {
    const bool isHidden = ghosts && (ghosts->GetValue(i) & vtkDataSetAttributes::HIDDENPOINT);
    outside->SetValue(i, given->GetComponent(i, 0) != 0 && !isHidden ? 1 : 0);
  }
  return outside;
}

} // namespace

void gridOfImage(vtkImageData* image, bool ofCells, double depth, vtkImageData* structure)
{
  int extent[6];
  image->GetExtent(extent);
  double origin[3];
  image->GetOrigin(origin);
  double spacing[3];
  image->GetSpacing(spacing);
  int flat = -1;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (extent[2 * axis + 1] == extent[2 * axis])
    {
      flat = axis;
      spacing[axis] = 1; // undefined in a plane, perhaps 0
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(spacing[axis] > 0) || !std::isfinite(spacing[axis]) || !std::isfinite(origin[axis]))
    {
      throw std::runtime_error(std::string("The input's spacing along its ") + "xyz"[axis] +
        " axis is " + textOf(spacing[axis]) + " and its origin " + textOf(origin[axis]) +
        "; the spacing must be positive and both finite. Correct the input.");
    }
  }
  if (ofCells)
  {
    double shift[3] = { 0, 0, 0 };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (extent[2 * axis + 1] > extent[2 * axis])
      {
        shift[axis] = spacing[axis] / 2;
        --extent[2 * axis + 1];
      }
    }
    double rotated[3];
    image->GetDirectionMatrix()->MultiplyPoint(shift, rotated);
    for (int axis = 0; axis < 3; ++axis)
    {
      origin[axis] += rotated[axis];
    }
  }
  structure->Initialize();
  structure->SetExtent(extent);
  structure->SetOrigin(origin);
  structure->SetSpacing(spacing);
  structure->SetDirectionMatrix(image->GetDirectionMatrix());
  if (flat >= 0)
  {
    extrudeGrid(structure, flat, depthOfImage(image, flat, depth));
  }
}

Tally convertImage(const Flow& flow, Numbers numbers, vtkImageData* output)
{
  const Leaf& leaf = flow.leaves[0];
  gridOfImage(flow.image, leaf.ofCells, flow.depth, output);
  vtkSmartPointer<vtkUnsignedCharArray> valid;
  if (hidesSome(flow.image))
  {
    valid = newMask(leaf.arrays[0]->GetNumberOfTuples());
  }
  if (valid && leaf.ofCells)
  {
    hideCells(flow.image, valid);
  }
  else if (valid)
  {
    hidePoints(flow.image, valid);
    hidePointsOfHiddenCells(flow.image, valid);
  }
  const Tally tally = setArrays(output, leaf.arrays, flow.model, valid, numbers);
  if (const auto outside = leaf.ofCells ? nullptr : outsideFrom(flow.image))
  {
    setOutside(outside, output);
  }
  if (const int flat = flatAxisOf(flow); flat >= 0)
  {
    extrudeArrays(output, flat);
  }
  return tally;
}

} // namespace filters
