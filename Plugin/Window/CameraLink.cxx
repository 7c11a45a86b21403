// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "CameraLink.h"

#include "UndoStep.h"

#include "pqRenderView.h"
#include "vtkNew.h"
#include "vtkSMCameraLink.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTrace.h"

#include <string>

namespace
{

void link(const std::string& name, vtkSMProxy* first, vtkSMProxy* second)
{
  vtkNew<vtkSMCameraLink> cameras;
  for (const int direction : { vtkSMLink::INPUT, vtkSMLink::OUTPUT })
  {
    cameras->AddLinkedProxy(first, direction);
    cameras->AddLinkedProxy(second, direction);
  }
  first->GetSessionProxyManager()->RegisterLink(name.c_str(), cameras);
}

} // namespace

//------------------------------------------------------------------------------
void linkCameras(pqRenderView* firstView, pqRenderView* secondView)
{
  vtkSMProxy* first = firstView->getProxy();
  vtkSMProxy* second = secondView->getProxy();
  vtkSMSessionProxyManager* manager = first->GetSessionProxyManager();
  std::string name;
  int number = 1;
  do
  {
    name = "SchlierenPictures" + std::to_string(number++);
  } while (manager->GetRegisteredLink(name.c_str()));

  SM_SCOPED_TRACE(CallFunction)
    .arg("AddCameraLink")
    .arg(first)
    .arg(second)
    .arg(name.c_str())
    .arg("comment", "link cameras in two views");
  // Not by pqLinksModel, which clears the undo stack.
  link(name, first, second);

  // A link that outlived its views would keep them.
  const ProxyById one(first);
  const ProxyById other(second);
  addUndoStep(
    [name, one]()
    {
      if (one.get())
      {
        one.get()->GetSessionProxyManager()->UnRegisterLink(name.c_str());
      }
    },
    [name, one, other]()
    {
      if (one.get() && other.get())
      {
        link(name, one.get(), other.get());
      }
    });
}
