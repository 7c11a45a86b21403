// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSchlierenArrayDomain.h"

#include "FlowArrays.h"

#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"

#include <cstring>
#include <string>

namespace
{

/// The density is for those flows alone whose index follows of it: then others' choice is left to the filter.
FlowDefaults defaultsFor(const char* property, const std::vector<FlowArray>& arrays)
{
  if (std::strcmp(property, "Density") == 0)
  {
    return flowDefaults(arrays);
  }
  if (std::strcmp(property, "IndexArray") != 0)
  {
    return flowDefaults(arrays, FlowDefaults::Ciddor);
  }
  const FlowDefaults index = flowDefaults(arrays, FlowDefaults::RefractiveIndex);
  return index.arrays.empty() ? flowDefaults(arrays, FlowDefaults::Refractivity) : index;
}

} // namespace

vtkStandardNewMacro(vtkSMSchlierenArrayDomain);

//------------------------------------------------------------------------------
void vtkSMSchlierenArrayDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
int vtkSMSchlierenArrayDomain::SetDefaultValues(vtkSMProperty* property, bool useUnchecked)
{
  const int isSet = this->Superclass::SetDefaultValues(property, useUnchecked);
  vtkSMPropertyHelper selection(property);
  selection.SetUseUnchecked(useUnchecked);
  vtkPVDataInformation* input = this->GetInputDataInformation("Input");
  if (!input || selection.GetNumberOfElements() != 5)
  {
    return isSet;
  }
  const FlowDefaults defaults = defaultsFor(property->GetXMLName(), arraysOf(input));
  std::string array = defaults.arrayOf(property->GetXMLName());
  if (array.empty() && std::strcmp(property->GetXMLName(), "Humidity") == 0)
  {
    array = "None"; // as the XML has it
  }
  constexpr unsigned int association = 3, name = 4;
  selection.Set(association, std::to_string(defaults.association).c_str());
  selection.Set(name, array.c_str());
  return 1;
}
