// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSchlierenBenchProxy.h"

#include "vtkObjectFactory.h"
#include "vtkPVSession.h"

vtkStandardNewMacro(vtkSMSchlierenBenchProxy);

//------------------------------------------------------------------------------
void vtkSMSchlierenBenchProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
void vtkSMSchlierenBenchProxy::CreateVTKObjects()
{
  this->Superclass::CreateVTKObjects();
  this->Location &= vtkPVSession::SERVERS;
}
