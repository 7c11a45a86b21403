// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSchlierenDensityDomain.h"

#include "FlowArrays.h"

#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkSMSchlierenDensityDomain);

//------------------------------------------------------------------------------
void vtkSMSchlierenDensityDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
int vtkSMSchlierenDensityDomain::SetDefaultValues(vtkSMProperty* property, bool useUnchecked)
{
  const int isSet = this->Superclass::SetDefaultValues(property, useUnchecked);
  vtkSMPropertyHelper selection(property);
  selection.SetUseUnchecked(useUnchecked);
  if (!isSet || selection.GetNumberOfElements() != 5)
  {
    return isSet;
  }
  constexpr unsigned int association = 3, name = 4;
  const std::vector<FlowArray> arrays = arraysOf(this->GetInputDataInformation("Input"));
  const auto chosen = std::find_if(arrays.begin(), arrays.end(),
    [&](const FlowArray& array)
    {
      return array.association == selection.GetAsInt(association) &&
        array.name == selection.GetAsString(name);
    });
  if (chosen != arrays.end() && isNoDensity(*chosen))
  {
    const FlowDefaults better = flowDefaults(arrays);
    const bool isDensity =
      better.isSure && !better.arrays.empty() && better.arrays[0].first == "Density";
    selection.Set(association, std::to_string(better.association).c_str());
    selection.Set(name, isDensity ? better.arrays[0].second.c_str() : "");
  }
  return isSet;
}
