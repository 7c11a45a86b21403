// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Image/LastImage.h"

#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkPointData.h"

#include <algorithm>

namespace filters
{

bool LastImage::IsThere() const { return this->Image->GetNumberOfPoints() > 0; }

bool LastImage::HasColor() const { return this->Image->GetPointData()->HasArray("Color") != 0; }

void LastImage::Keep(vtkImageData* output) { this->Image->ShallowCopy(output); }

void LastImage::Drop() { this->Image->Initialize(); }

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
  vtkNew<vtkIdList> from;
  from->SetNumberOfIds(pixels);
  for (vtkIdType pixel = 0; pixel < pixels; ++pixel)
  {
    const vtkIdType column = (2 * (pixel % wants[0]) + 1) * has[0] / (2 * vtkIdType{ wants[0] });
    const vtkIdType row = (2 * (pixel / wants[0]) + 1) * has[1] / (2 * vtkIdType{ wants[1] });
    from->SetId(pixel, row * has[0] + column);
  }
  vtkPointData* source = this->Image->GetPointData();
  vtkPointData* arrays = output->GetPointData();
  arrays->Initialize();
  arrays->CopyAllOn();
  arrays->CopyAllocate(source, pixels);
  arrays->SetNumberOfTuples(pixels);
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(i);
    source->GetArray(array->GetName())->GetTuples(from, array);
  }
  this->Image->ShallowCopy(output); // the next update will show the same
}

} // namespace filters
