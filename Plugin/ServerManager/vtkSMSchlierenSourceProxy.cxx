// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSchlierenSourceProxy.h"

#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"

vtkStandardNewMacro(vtkSMSchlierenSourceProxy);

//------------------------------------------------------------------------------
void vtkSMSchlierenSourceProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
void vtkSMSchlierenSourceProxy::PostUpdateData(bool usingCache)
{
  this->Superclass::PostUpdateData(usingCache);
  vtkSMProperty* information = this->GetProperty("LockedKInformation");
  this->UpdatePropertyInformation(information);
  const double k = vtkSMPropertyHelper(information).GetAsDouble();
  vtkSMPropertyHelper kept(this, "LockedK");
  if (kept.GetAsDouble() != k)
  {
    kept.Set(k);
  }
}
