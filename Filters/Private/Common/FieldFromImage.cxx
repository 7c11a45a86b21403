// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/FieldFromImage.h"

#include "Common/AvailableMemory.h"
#include "Common/Leaf.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstring>

namespace filters
{

namespace
{

vtkUnsignedCharArray* bytesOf(vtkImageData* image, const char* name)
{
  return vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetArray(name));
}

} // namespace

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

schlieren::Field fieldFrom(vtkImageData* refractivity)
{
  vtkDataArray* values = refractivity->GetPointData()->GetArray("Refractivity");
  auto* floats = vtkFloatArray::SafeDownCast(values);
  auto* doubles = vtkDoubleArray::SafeDownCast(values);
  schlieren::Field field;
  field.grid = gridFrom(refractivity);
  field.singles = floats ? floats->GetPointer(0) : nullptr;
  field.doubles = doubles ? doubles->GetPointer(0) : nullptr;
  if (vtkDataArray* offset = refractivity->GetFieldData()->GetArray("RefractivityOffset"))
  {
    field.offset = offset->GetComponent(0, 0);
  }
  auto* mask = bytesOf(refractivity, maskName);
  field.valid = mask ? mask->GetPointer(0) : nullptr;
  field.version = refractivity->GetMTime();
  return field;
}

void mergeMasks(vtkImageData* refractivity)
{
  vtkPointData* arrays = refractivity->GetPointData();
  auto* valid = bytesOf(refractivity, maskName);
  const auto count = static_cast<std::size_t>(valid->GetNumberOfValues());
  if (std::memchr(valid->GetPointer(0), 0, count) == nullptr)
  {
    arrays->RemoveArray(maskName);
  }
  else if (auto* outside = bytesOf(refractivity, transparentName))
  {
    vtkNew<vtkUnsignedCharArray> merged; // the others may belong to the input
    merged->SetName(maskName);
    setTuples(merged, valid->GetNumberOfValues());
    std::transform(valid->GetPointer(0), valid->GetPointer(0) + count, outside->GetPointer(0),
      merged->GetPointer(0),
      [](unsigned char isValid, unsigned char isOutside)
      { return isOutside ? schlieren::transparent : isValid; });
    arrays->AddArray(merged);
  }
  arrays->RemoveArray(transparentName);
}

} // namespace filters
