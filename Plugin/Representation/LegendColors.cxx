// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LegendColors.h"

#include "vtkScalarsToColors.h"

#include <algorithm>

vtkSmartPointer<vtkUnsignedCharArray> paintedLight(
  vtkUnsignedCharArray* colors, double white, vtkScalarsToColors* map)
{
  if (!map)
  {
    return colors;
  }
  auto painted = vtkSmartPointer<vtkUnsignedCharArray>::New();
  painted->SetNumberOfComponents(3);
  painted->SetNumberOfTuples(colors->GetNumberOfTuples());
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    const unsigned char* grey = colors->GetPointer(3 * i);
    if (grey[0] != grey[1] || grey[0] != grey[2])
    {
      return nullptr;
    }
    std::copy_n(map->MapValue(grey[0] / 255. * white), 3, painted->GetPointer(3 * i));
  }
  return painted;
}
