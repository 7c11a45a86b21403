// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSchlierenBenchProxy.h"

#include "vtkObjectFactory.h"
#include "vtkPVSession.h"

vtkStandardNewMacro(vtkSMSchlierenBenchProxy);

void vtkSMSchlierenBenchProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

void vtkSMSchlierenBenchProxy::CreateVTKObjects()
{
  if (this->ObjectsCreated)
  {
    return;
  }
  this->Superclass::CreateVTKObjects();
  this->Location &= vtkPVSession::SERVERS;
  // Reads information before panels do; sources get theirs by their first update.
  this->UpdatePropertyInformation();
}
