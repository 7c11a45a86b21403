// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/LastImage.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace filters
{

//------------------------------------------------------------------------------
bool LastImage::IsThere() const { return this->Image->GetNumberOfPoints() > 0; }

//------------------------------------------------------------------------------
bool LastImage::HasColor() const { return this->Image->GetPointData()->HasArray("Color") != 0; }

//------------------------------------------------------------------------------
void LastImage::Keep(vtkImageData* output) { this->Image->ShallowCopy(output); }

//------------------------------------------------------------------------------
void LastImage::Drop() { this->Image->Initialize(); }

//------------------------------------------------------------------------------
void LastImage::Show(vtkImageData* output, const int promised[6])
{
  output->ShallowCopy(this->Image);
  const int* has = this->Image->GetDimensions();
  const int wants[2] = { promised[1] - promised[0] + 1, promised[3] - promised[2] + 1 };
  if (!this->IsThere() || std::equal(wants, wants + 2, has) || wants[0] < 1 || wants[1] < 1)
  {
    return;
  }
  // Keeps the image's borders.
  double origin[3], spacing[3];
  this->Image->GetOrigin(origin);
  this->Image->GetSpacing(spacing);
  for (int axis = 0; axis < 2; ++axis)
  {
    const double before = spacing[axis];
    spacing[axis] *= static_cast<double>(has[axis]) / wants[axis];
    origin[axis] += (spacing[axis] - before) / 2;
  }
  output->SetExtent(0, wants[0] - 1, 0, wants[1] - 1, 0, 0);
  output->SetOrigin(origin);
  output->SetSpacing(spacing);

  const vtkIdType pixels = vtkIdType{ wants[0] } * wants[1];
  std::vector<vtkIdType> from(static_cast<std::size_t>(pixels));
  for (vtkIdType pixel = 0; pixel < pixels; ++pixel)
  {
    const vtkIdType column = (2 * (pixel % wants[0]) + 1) * has[0] / (2 * vtkIdType{ wants[0] });
    const vtkIdType row = (2 * (pixel / wants[0]) + 1) * has[1] / (2 * vtkIdType{ wants[1] });
    from[static_cast<std::size_t>(pixel)] = row * has[0] + column;
  }
  vtkPointData* source = this->Image->GetPointData();
  vtkPointData* arrays = output->GetPointData();
  arrays->Initialize();
  arrays->CopyAllOn();
  arrays->CopyAllocate(source, pixels);
  arrays->SetNumberOfTuples(pixels);
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    // Copies bytes, several times as fast as CopyData, because all arrays are plain numbers.
    vtkDataArray* array = arrays->GetArray(i);
    const auto bytes =
      static_cast<std::size_t>(array->GetNumberOfComponents() * array->GetDataTypeSize());
    const auto* old =
      static_cast<const char*>(source->GetArray(array->GetName())->GetVoidPointer(0));
    auto* made = static_cast<char*>(array->GetVoidPointer(0));
    for (const vtkIdType pixel : from)
    {
      std::memcpy(made, old + static_cast<std::size_t>(pixel) * bytes, bytes);
      made += bytes;
    }
  }
  this->Image->ShallowCopy(output); // the next update will show the same
}

} // namespace filters
