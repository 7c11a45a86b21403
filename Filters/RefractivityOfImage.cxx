// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractivityOfImage.h"

#include "RefractivityOutside.h"
#include "RefractivityValues.h"

#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace refractivity
{

namespace
{

/// Calls visit(cell, its eight corners) for every cell of a 3-D image.
template <class Visit>
void forCells(vtkImageData* image, const Visit& visit)
{
  int points[3];
  image->GetDimensions(points);
  const vtkIdType nx = points[0];
  const vtkIdType nxy = nx * points[1];
  vtkIdType cell = 0;
  for (int k = 0; k < points[2] - 1; ++k)
  {
    for (int j = 0; j < points[1] - 1; ++j)
    {
      for (int i = 0; i < points[0] - 1; ++i)
      {
        const vtkIdType p = k * nxy + j * nx + i;
        visit(cell++,
          std::array<vtkIdType, 8>{
            p, p + 1, p + nx, p + nx + 1, p + nxy, p + nxy + 1, p + nxy + nx, p + nxy + nx + 1 });
      }
    }
  }
}

/// Hides the points whose cells are all hidden, so that a body of m cells loses m - 1 points; and all
/// points of a hidden cell that has no hidden point then, so that thin bodies do not vanish.
void hidePointsOfHiddenCells(vtkImageData* image, vtkUnsignedCharArray* valid)
{
  vtkUnsignedCharArray* ghosts = image->GetCellGhostArray();
  if (!ghosts || image->GetDataDimension() != 3)
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

/// Hides hidden cells and cells that have a hidden point.
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
  if (!ghosts || image->GetDataDimension() != 3)
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

} // namespace

void gridOfImage(vtkImageData* image, bool ofCells, vtkImageData* structure)
{
  int extent[6];
  image->GetExtent(extent);
  double origin[3];
  image->GetOrigin(origin);
  double spacing[3];
  image->GetSpacing(spacing);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(spacing[axis] > 0) || !std::isfinite(spacing[axis]) || !std::isfinite(origin[axis]))
    {
      throw std::runtime_error(std::string("The input's spacing along its ") + "xyz"[axis] +
        " axis is " + std::to_string(spacing[axis]) + " and its origin " +
        std::to_string(origin[axis]) +
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
}

Tally convertImage(const Source& source, bool doublePrecision, vtkImageData* output)
{
  const Leaf& leaf = source.leaves[0];
  gridOfImage(source.image, leaf.ofCells, output);
  auto valid = newMask(output->GetNumberOfPoints());
  if (leaf.ofCells)
  {
    hideCells(source.image, valid);
  }
  else
  {
    hidePoints(source.image, valid);
    hidePointsOfHiddenCells(source.image, valid);
  }
  const Tally tally = setArrays(output, leaf.arrays, source.model, valid, doublePrecision);
  if (const auto outside = leaf.ofCells ? nullptr : outsideFrom(source.image))
  {
    setOutside(outside, output);
  }
  return tally;
}

} // namespace refractivity
