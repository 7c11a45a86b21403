// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LastPicture.h"

#include "vtkIdList.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cstdint>

//------------------------------------------------------------------------------
bool LastPicture::IsThere() const { return this->Picture->GetNumberOfPoints() > 0; }

//------------------------------------------------------------------------------
void LastPicture::Keep(vtkImageData* output) { this->Picture->ShallowCopy(output); }

//------------------------------------------------------------------------------
void LastPicture::Drop() { this->Picture->Initialize(); }

//------------------------------------------------------------------------------
void LastPicture::Show(vtkImageData* output, const int promised[6])
{
  output->ShallowCopy(this->Picture);
  const int* has = this->Picture->GetDimensions();
  const int wants[2] = { promised[1] - promised[0] + 1, promised[3] - promised[2] + 1 };
  if (!this->IsThere() || std::equal(wants, wants + 2, has) || wants[0] < 1 || wants[1] < 1)
  {
    return;
  }
  // The same borders.
  double origin[3], spacing[3];
  this->Picture->GetOrigin(origin);
  this->Picture->GetSpacing(spacing);
  for (int axis = 0; axis < 2; ++axis)
  {
    const double before = spacing[axis];
    spacing[axis] *= static_cast<double>(has[axis]) / wants[axis];
    origin[axis] += (spacing[axis] - before) / 2;
  }
  output->SetExtent(0, wants[0] - 1, 0, wants[1] - 1, 0, 0);
  output->SetOrigin(origin);
  output->SetSpacing(spacing);

  vtkNew<vtkIdList> from, to;
  const vtkIdType pixels = vtkIdType{ wants[0] } * wants[1];
  from->SetNumberOfIds(pixels);
  to->SetNumberOfIds(pixels);
  for (vtkIdType pixel = 0; pixel < pixels; ++pixel)
  {
    const vtkIdType column = (2 * (pixel % wants[0]) + 1) * has[0] / (2 * vtkIdType{ wants[0] });
    const vtkIdType row = (2 * (pixel / wants[0]) + 1) * has[1] / (2 * vtkIdType{ wants[1] });
    from->SetId(pixel, row * has[0] + column);
    to->SetId(pixel, pixel);
  }
  vtkPointData* arrays = output->GetPointData();
  arrays->Initialize();
  arrays->CopyAllOn();
  arrays->CopyAllocate(this->Picture->GetPointData(), pixels);
  arrays->SetNumberOfTuples(pixels);
  arrays->CopyData(this->Picture->GetPointData(), from, to);
  this->Picture->ShallowCopy(output); // the next slice will want the same
}
