// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSchlierenArrayDomain.h"

#include "FlowArrays.h"

#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"

#include <string>

namespace
{

// Of a property that selects an array.
constexpr unsigned int elements = 5, associationElement = 3, nameElement = 4;

/// The density is for those flows alone whose index follows of it: then others' choice is left to the filter.
FlowDefaults defaultsFor(const std::string& property, const std::vector<FlowArray>& arrays)
{
  if (property == "Density")
  {
    return flowDefaults(arrays);
  }
  if (property != "IndexArray")
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
  // Without an input there is no information, which the superclass does not expect where it has a string for no array.
  vtkPVDataInformation* input = this->GetInputDataInformation("Input");
  const std::string name = property->GetXMLName();
  vtkSMPropertyHelper selection(property);
  selection.SetUseUnchecked(useUnchecked);
  if (!input || name == "Mask" || selection.GetNumberOfElements() != elements)
  {
    return 0; // as the XML has it
  }
  const FlowDefaults defaults = defaultsFor(name, arraysOf(input));
  std::string array = defaults.arrayOf(name);
  if (array.empty() && this->GetNoneString())
  {
    array = this->GetNoneString();
  }
  selection.Set(associationElement, std::to_string(defaults.association).c_str());
  selection.Set(nameElement, array.c_str());
  return 1;
}
