// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSchlierenRepresentationProxy.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"

vtkStandardNewMacro(vtkSMSchlierenRepresentationProxy);

void vtkSMSchlierenRepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

void vtkSMSchlierenRepresentationProxy::PostUpdateData(bool usingCache)
{
  this->Superclass::PostUpdateData(usingCache);
  if (vtkSMProxy* bench = vtkSMPropertyHelper(this, "Bench").GetAsProxy())
  {
    bench->InvokeEvent(vtkCommand::UpdateDataEvent);
  }
}
