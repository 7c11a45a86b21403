// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSchlierenArrayDomain.h"

#include "FlowArrays.h"

#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace
{

// Elements of a property that selects an array.
constexpr unsigned int elements = 5, associationElement = 3, nameElement = 4;

/// Chooses a density only for flows whose index follows from it; others are left to the filter.
FlowDefaults defaultsFor(const std::string& property, const std::vector<FlowArray>& arrays)
{
  if (property == "Density")
  {
    return flowDefaults(arrays);
  }
  if (property != "IndexArray")
  {
    return flowDefaults(arrays, MediumSettings::CIDDOR);
  }
  for (const auto model : { MediumSettings::REFRACTIVE_INDEX, MediumSettings::REFRACTIVITY })
  {
    FlowDefaults index = flowDefaults(arrays, model);
    if (!index.arrays.empty())
    {
      return index;
    }
  }
  return flowDefaults(arrays, MediumSettings::ELECTRON_DENSITY);
}

/// Chooses an array; an empty name: none is known.
std::pair<FlowArray::Association, std::string> choiceFor(
  const std::string& property, const std::vector<FlowArray>& arrays)
{
  if (property == "Mask")
  {
    const MaskDefault mask = flowMask(arrays);
    return { mask.association, mask.array.empty() && !arrays.empty() ? "None" : mask.array };
  }
  const FlowDefaults defaults = defaultsFor(property, arrays);
  return { defaults.association, defaults.arrayOf(property) };
}

} // namespace

vtkStandardNewMacro(vtkSMSchlierenArrayDomain);

void vtkSMSchlierenArrayDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

int vtkSMSchlierenArrayDomain::SetDefaultValues(vtkSMProperty* property, bool useUnchecked)
{
  // Skips inputs without information, for which the superclass fails on a string for no array.
  vtkPVDataInformation* input = this->GetInputDataInformation("Input");
  const std::string name = property->GetXMLName();
  vtkSMPropertyHelper selection(property);
  selection.SetUseUnchecked(useUnchecked);
  if (!input || selection.GetNumberOfElements() != elements)
  {
    return 0; // the XML's value
  }
  const auto [association, array] = choiceFor(name, arraysOf(input));
  this->Chosen = array;
  if (this->Chosen.empty())
  {
    return 0; // makes ParaView try again
  }
  selection.Set(associationElement, std::to_string(association).c_str());
  selection.Set(nameElement, this->Chosen.c_str());
  return 1;
}

void vtkSMSchlierenArrayDomain::Update(vtkSMProperty* requestingProperty)
{
  this->Superclass::Update(requestingProperty);
  vtkSMProperty* property = this->GetProperty();
  vtkPVDataInformation* input = this->GetInputDataInformation("Input");
  if (this->Chosen.empty() || !property || !input)
  {
    return;
  }
  vtkSMPropertyHelper selection(property);
  const std::vector<FlowArray> arrays = arraysOf(input);
  const bool isThere = std::any_of(arrays.begin(), arrays.end(),
    [this](const FlowArray& array) { return array.name == this->Chosen; });
  const bool isByItself = selection.GetNumberOfElements() == elements &&
    this->Chosen == selection.GetAsString(nameElement);
  if (isByItself && !isThere && !arrays.empty())
  {
    // Chooses again, because scripts get the active source as their first input.
    if (!this->SetDefaultValues(property, false))
    {
      const char* none = this->GetNoneString();
      selection.Set(nameElement, none ? none : "");
    }
  }
}
