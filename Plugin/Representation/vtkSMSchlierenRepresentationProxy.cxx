// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMSchlierenRepresentationProxy.h"

#include "vtkSchlierenImageInformation.h"
#include "vtkSchlierenRepresentation.h"

#include "vtkClientServerStream.h"
#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVSession.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSession.h"
#include "vtkWeakPointer.h"

vtkStandardNewMacro(vtkSMSchlierenRepresentationProxy);

//------------------------------------------------------------------------------
vtkSMSchlierenRepresentationProxy::vtkSMSchlierenRepresentationProxy() = default;

//------------------------------------------------------------------------------
vtkSMSchlierenRepresentationProxy::~vtkSMSchlierenRepresentationProxy() = default;

//------------------------------------------------------------------------------
void vtkSMSchlierenRepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
void vtkSMSchlierenRepresentationProxy::CreateVTKObjects()
{
  if (this->ObjectsCreated)
  {
    return;
  }
  this->Superclass::CreateVTKObjects();
  auto* here = vtkSchlierenRepresentation::SafeDownCast(this->GetClientSideObject());
  const bool hasServer =
    this->Session && !(this->Session->GetProcessRoles() & vtkPVSession::DATA_SERVER);
  if (!here || !hasServer)
  {
    return;
  }
  here->SetRequest([self = vtkWeakPointer<vtkSMSchlierenRepresentationProxy>(this)](
                     const double request[16]) { return self ? self->Fetch(request) : nullptr; });
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> vtkSMSchlierenRepresentationProxy::Fetch(const double request[16])
{
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(this) << "TraceForClient"
         << vtkClientServerStream::InsertArray(request, 16) << vtkClientServerStream::End;
  this->ExecuteStream(stream, false, vtkPVSession::DATA_SERVER);
  vtkNew<vtkSchlierenImageInformation> information;
  this->GatherInformation(information, vtkPVSession::DATA_SERVER);
  return information->GetImage();
}

//------------------------------------------------------------------------------
void vtkSMSchlierenRepresentationProxy::PostUpdateData(bool usingCache)
{
  this->Superclass::PostUpdateData(usingCache);
  if (vtkSMProxy* bench = vtkSMPropertyHelper(this, "Bench").GetAsProxy())
  {
    bench->InvokeEvent(vtkCommand::UpdateDataEvent);
  }
}
