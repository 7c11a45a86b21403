// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSchlierenLockDomain.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <string>

vtkStandardNewMacro(vtkSMSchlierenLockDomain);

void vtkSMSchlierenLockDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

void vtkSMSchlierenLockDomain::Update(vtkSMProperty*) {}

int vtkSMSchlierenLockDomain::ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element)
{
  if (!this->Superclass::ReadXMLAttributes(property, element))
  {
    return 0;
  }
  property->GetParent()->AddObserver(
    vtkCommand::UpdateDataEvent, this, &vtkSMSchlierenLockDomain::OnUpdate);
  return 1;
}

void vtkSMSchlierenLockDomain::OnUpdate(vtkObject* object, unsigned long, void*)
{
  auto* proxy = vtkSMProxy::SafeDownCast(object);
  if (!proxy || !this->GetProperty())
  {
    return;
  }
  const std::string name = std::string(this->GetProperty()->GetXMLName()) + "Information";
  vtkSMProperty* information = proxy->GetProperty(name.c_str());
  if (!information)
  {
    return;
  }
  proxy->UpdatePropertyInformation(information);
  const double number = vtkSMPropertyHelper(information).GetAsDouble();
  vtkSMPropertyHelper kept(this->GetProperty());
  if (kept.GetAsDouble() != number)
  {
    kept.Set(number);
  }
}
