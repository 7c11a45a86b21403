// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FlatData.h"

#include "CellTypes.h"

#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <stdexcept>

namespace refractivity
{

namespace
{

/// Thickness of a plane, in parts of its length: what rounding in single precision makes.
constexpr double planeTolerance = 1e-6;

/// The largest dimension of the cells.
int dimensionOf(vtkDataSet* data)
{
  int dimension = 0;
  for (vtkIdType i = 0; i < data->GetNumberOfCells() && dimension < 3; ++i)
  {
    dimension = std::max(dimension, dimensionOfCell(data, i));
  }
  return dimension;
}

/// The axis along which there is nothing. -1 for none; throws for several.
int onlyFlatAxis(const bool isFlat[3], const Source& source)
{
  if (std::count(isFlat, isFlat + 3, true) > 1)
  {
    throw std::runtime_error("The input with the " + source.label +
      " is a line or a point, so there is no volume for light to cross. Use 3-D or 2-D data.");
  }
  return isFlat[0] ? 0 : (isFlat[1] ? 1 : (isFlat[2] ? 2 : -1));
}

} // namespace

int dimensionOfCell(vtkDataSet* data, vtkIdType cell)
{
  static std::array<std::atomic<int>, 256>
    known; // one more than the dimension; 0: not yet asked for
  const auto type = static_cast<unsigned char>(data->GetCellType(cell));
  if (known[type] == 0)
  {
    known[type] = 1 + vtkCellTypeUtilities::GetDimension(type);
  }
  return known[type] - 1;
}

int flatAxisOf(const Source& source)
{
  if (source.image)
  {
    const int* points = source.image->GetDimensions();
    const bool isFlat[3] = { points[0] == 1, points[1] == 1, points[2] == 1 };
    return onlyFlatAxis(isFlat, source);
  }
  int dimension = 0;
  vtkBoundingBox box;
  for (const Leaf& leaf : source.leaves)
  {
    const int ofLeaf = dimensionOf(leaf.data);
    if (ofLeaf == 3)
    {
      return -1;
    }
    if (ofLeaf == 2)
    {
      box.AddBounds(leaf.data->GetBounds());
    }
    dimension = std::max(dimension, ofLeaf);
  }
  const std::string problem = "The input has no 3-D cells with the " + source.label +
    ", so there is no volume for light to cross";
  if (dimension < 2)
  {
    throw std::runtime_error(problem + ". Use 3-D data, or 2-D data in one plane.");
  }
  double lengths[3];
  box.GetLengths(lengths);
  bool isFlat[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    isFlat[axis] = lengths[axis] <= planeTolerance * box.GetMaxLength();
  }
  const int flat = onlyFlatAxis(isFlat, source);
  if (flat < 0)
  {
    throw std::runtime_error(problem +
      ", and its surfaces do not lie in one plane across the x, y or z axis. Use volume data, or "
      "turn "
      "a plane (Transform) until it does: then it is extruded.");
  }
  return flat;
}

std::string warningOfExtrusion(int flat)
{
  return std::string("The data are 2-D: they are extruded by one data unit along ") + "xyz"[flat] +
    ", half of it to each side. Deflection and optical path are those of this length.";
}

void extrudeGrid(vtkImageData* grid, int flat)
{
  int extent[6];
  grid->GetExtent(extent);
  extent[2 * flat] = 0;
  extent[2 * flat + 1] = 1;
  double corner[3] = { 0, 0, 0 }, offset[3] = { 0, 0, 0 }, origin[3], spacing[3];
  grid->GetSpacing(spacing);
  grid->GetOrigin(origin);
  corner[flat] = spacing[flat] * grid->GetExtent()[2 * flat] - 0.5;
  grid->GetDirectionMatrix()->MultiplyPoint(corner, offset);
  spacing[flat] = 1;
  grid->SetExtent(extent);
  grid->SetSpacing(spacing);
  grid->SetOrigin(origin[0] + offset[0], origin[1] + offset[1], origin[2] + offset[2]);
}

void extrudeArrays(vtkImageData* image, int flat)
{
  int points[3];
  image->GetDimensions(points);
  const vtkIdType stride =
    flat == 0 ? 1 : static_cast<vtkIdType>(points[0]) * (flat == 1 ? 1 : points[1]);
  const vtkIdType layers = image->GetNumberOfPoints() / stride / 2; // runs of one layer
  vtkPointData* arrays = image->GetPointData();
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(i);
    auto single = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
    single->DeepCopy(array);
    array->SetNumberOfTuples(image->GetNumberOfPoints());
    for (vtkIdType run = 0; run < layers; ++run)
    {
      array->InsertTuples(2 * run * stride, stride, run * stride, single);
      array->InsertTuples((2 * run + 1) * stride, stride, run * stride, single);
    }
  }
}

} // namespace refractivity
