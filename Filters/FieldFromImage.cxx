// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FieldFromImage.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstring>

namespace
{

/// The mask of a refractivity grid, with what its TransparentPointMask adds in `storage`; null where all
/// is gas.
const unsigned char* maskFrom(vtkPointData* arrays, std::vector<unsigned char>& storage)
{
  const auto bytesOf = [arrays](const char* name)
  { return vtkUnsignedCharArray::SafeDownCast(arrays->GetArray(name)); };
  auto* valid = bytesOf("vtkValidPointMask");
  auto* outside = bytesOf("TransparentPointMask");
  if (!valid || !outside)
  {
    return valid ? valid->GetPointer(0) : nullptr;
  }
  storage.resize(static_cast<std::size_t>(valid->GetNumberOfValues()));
  std::transform(valid->GetPointer(0), valid->GetPointer(0) + storage.size(),
    outside->GetPointer(0), storage.begin(),
    [](unsigned char isValid, unsigned char isOutside)
    { return isOutside ? schlieren::transparent : isValid; });
  return storage.data();
}

} // namespace

//------------------------------------------------------------------------------
schlieren::Grid gridFrom(vtkImageData* image)
{
  schlieren::Grid grid;
  int dimensions[3];
  image->GetDimensions(dimensions);
  std::copy_n(dimensions, 3, grid.dimensions.begin());
  std::copy_n(image->GetSpacing(), 3, grid.spacing.begin());
  std::copy_n(image->GetDirectionMatrix()->GetData(), 9, grid.direction.begin());
  const int* extent = image->GetExtent();
  image->TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], grid.origin.data());
  return grid;
}

//------------------------------------------------------------------------------
schlieren::Field fieldFrom(vtkImageData* refractivity, std::vector<unsigned char>& mask)
{
  vtkDataArray* values = refractivity->GetPointData()->GetArray("Refractivity");
  auto* floats = vtkFloatArray::SafeDownCast(values);
  auto* doubles = vtkDoubleArray::SafeDownCast(values);
  schlieren::Field field;
  field.grid = gridFrom(refractivity);
  field.singles = floats ? floats->GetPointer(0) : nullptr;
  field.doubles = doubles ? doubles->GetPointer(0) : nullptr;
  field.valid = maskFrom(refractivity->GetPointData(), mask);
  field.version = refractivity->GetMTime();
  return field;
}

//------------------------------------------------------------------------------
void dropMaskOfOnes(vtkImageData* refractivity)
{
  vtkPointData* arrays = refractivity->GetPointData();
  auto* valid = vtkUnsignedCharArray::SafeDownCast(arrays->GetArray("vtkValidPointMask"));
  const auto count = static_cast<std::size_t>(valid->GetNumberOfValues());
  if (std::memchr(valid->GetPointer(0), 0, count) == nullptr)
  {
    arrays->RemoveArray("vtkValidPointMask");
  }
}
