// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "FlowDefaults.h"

#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"

#include <vector>

/// Lists the arrays of points and cells in a server's description of its data.
inline std::vector<FlowArray> arraysOf(vtkPVDataInformation* data)
{
  std::vector<FlowArray> arrays;
  if (!data)
  {
    return arrays; // the proxy has no input
  }
  for (const FlowArray::Association association : { FlowArray::Points, FlowArray::Cells })
  {
    vtkPVDataSetAttributesInformation* info = data->GetAttributeInformation(association);
    for (int i = 0; i < info->GetNumberOfArrays(); ++i)
    {
      vtkPVArrayInformation* array = info->GetArrayInformation(i);
      if (!array || !array->GetName())
      {
        continue;
      }
      const double* range = array->GetComponentFiniteRange(0);
      arrays.push_back(
        { array->GetName(), association, array->GetNumberOfComponents(), { range[0], range[1] } });
    }
  }
  return arrays;
}
