// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSchlierenQualityDomain.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMUncheckedPropertyHelper.h"
#include "vtkSchlierenFilter.h"

using Filter = vtkSchlierenFilter;

vtkStandardNewMacro(vtkSMSchlierenQualityDomain);

void vtkSMSchlierenQualityDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

void vtkSMSchlierenQualityDomain::Update(vtkSMProperty*) {}

int vtkSMSchlierenQualityDomain::ReadXMLAttributes(
  vtkSMProperty* property, vtkPVXMLElement* element)
{
  if (!this->Superclass::ReadXMLAttributes(property, element))
  {
    return 0;
  }
  const auto observe = [this](vtkSMProperty* observed)
  {
    for (const auto event :
      { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
    {
      observed->AddObserver(event, this, &vtkSMSchlierenQualityDomain::OnModified);
    }
  };
  observe(property);
  for (int i = 0; const char* name = Filter::GetQualitySetting(i); ++i)
  {
    vtkSMProperty* setting = this->GetRequiredProperty(name);
    if (!setting)
    {
      vtkErrorMacro(<< "The required property " << name << " is missing.");
      return 0;
    }
    observe(setting);
  }
  return 1;
}

void vtkSMSchlierenQualityDomain::OnModified(vtkObject* property, unsigned long event, void*)
{
  if (this->Following || !this->GetProperty())
  {
    return;
  }
  this->Following = true;
  if (event == vtkCommand::ModifiedEvent)
  {
    this->Follow<vtkSMPropertyHelper>(vtkSMProperty::SafeDownCast(property));
  }
  else
  {
    this->Follow<vtkSMUncheckedPropertyHelper>(vtkSMProperty::SafeDownCast(property));
  }
  this->Following = false;
}

template <class Helper>
void vtkSMSchlierenQualityDomain::Follow(vtkSMProperty* modified)
{
  Helper quality(this->GetProperty());
  const auto isEmpty = [](vtkSMProperty* property)
  { return Helper(property).GetNumberOfElements() == 0; };
  bool lacksElements = isEmpty(this->GetProperty());
  for (int i = 0; const char* name = Filter::GetQualitySetting(i); ++i)
  {
    lacksElements = lacksElements || isEmpty(this->GetRequiredProperty(name));
  }
  if (lacksElements)
  {
    return; // the XML is still being read, or a state file has a property without elements
  }
  const auto isPreset = [this](int preset)
  {
    for (int i = 0; const char* name = Filter::GetQualitySetting(i); ++i)
    {
      if (Helper(this->GetRequiredProperty(name)).GetAsDouble() !=
        Filter::GetQualityValue(preset, i))
      {
        return false;
      }
    }
    return true;
  };
  vtkSMSessionProxyManager* manager = modified->GetParent()->GetSessionProxyManager();
  const bool isLoaded = manager && manager->GetInLoadXMLState();
  if (modified == this->GetProperty() && !isLoaded)
  {
    for (int i = 0; const char* name = Filter::GetQualitySetting(i); ++i)
    {
      if (quality.GetAsInt() != Filter::CUSTOM)
      {
        Helper(this->GetRequiredProperty(name)).Set(Filter::GetQualityValue(quality.GetAsInt(), i));
      }
    }
    return;
  }
  vtkSMProperty* target = this->GetRequiredProperty("TargetError");
  const bool isChosenByTarget =
    modified != target && modified != this->GetRequiredProperty("PathModel");
  if (!isLoaded && isChosenByTarget && Helper(target).GetAsDouble() < 0)
  {
    // A setting that is changed is to have its effect.
    Helper(target).Set(0);
  }
  int preset = Filter::INTERACTIVE;
  while (preset < Filter::CUSTOM && !isPreset(preset))
  {
    ++preset;
  }
  quality.Set(preset);
}
