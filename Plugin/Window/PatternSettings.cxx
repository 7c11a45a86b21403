// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PatternSettings.h"

#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyListDomain.h"
#include "vtkSchlierenFilter.h"
#include "vtkSmartPointer.h"

#include <cstring>

void copySettings(vtkSMProxy* from, vtkSMProxy* to)
{
  auto properties = vtkSmartPointer<vtkSMPropertyIterator>::Take(to->NewPropertyIterator());
  for (; !properties->IsAtEnd(); properties->Next())
  {
    const char* name = properties->GetKey();
    vtkSMProperty* property = properties->GetProperty();
    vtkSMProperty* pattern = from->GetProperty(name);
    if (!pattern || property->GetInformationOnly() || property->GetIsInternal() ||
      std::strcmp(name, "Input") == 0)
    {
      continue;
    }
    if (property->FindDomain<vtkSMProxyListDomain>())
    {
      // Copies curves, which filters do not share.
      vtkSMProxy* curve = vtkSMPropertyHelper(property).GetAsProxy();
      curve->Copy(vtkSMPropertyHelper(pattern).GetAsProxy());
      curve->UpdateVTKObjects();
      continue;
    }
    property->Copy(pattern);
  }
}

void useKOf(vtkSMProxy* from, vtkSMProxy* to)
{
  const auto valueOf = [](vtkSMProxy* proxy, const char* name)
  { return vtkSMPropertyHelper(proxy, name).GetAsInt(); };
  if (valueOf(from, "Cutoff") == valueOf(to, "Cutoff") &&
    valueOf(to, "KMode") == vtkSchlierenFilter::K_AUTOMATIC_KEPT)
  {
    from->UpdatePropertyInformation(from->GetProperty("AutomaticUsed"));
    vtkSMPropertyHelper(to, "LockedK")
      .Set(vtkSMPropertyHelper(from, "AutomaticUsed").GetAsDouble());
  }
}
