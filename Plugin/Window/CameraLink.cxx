// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "CameraLink.h"

#include "UndoStep.h"

#include "pqApplicationCore.h"
#include "pqRenderView.h"
#include "pqUndoStack.h"
#include "vtkNew.h"
#include "vtkSMCameraLink.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTrace.h"
#include "vtkSmartPointer.h"

#include <QSignalBlocker>

#include <string>

namespace
{

void link(vtkSMCameraLink* cameras, const std::string& name, vtkSMProxy* first, vtkSMProxy* second)
{
  for (const int direction : { vtkSMLink::INPUT, vtkSMLink::OUTPUT })
  {
    cameras->AddLinkedProxy(first, direction);
    cameras->AddLinkedProxy(second, direction);
  }
  SCOPED_UNDO_EXCLUDE();
  first->GetSessionProxyManager()->RegisterLink(name.c_str(), cameras);
}

/// ParaView clears the undo stack when a link goes, here in the middle of undoing: so it gets none.
void unlink(vtkSMCameraLink* cameras, const std::string& name, vtkSMProxy* view)
{
  pqApplicationCore* core = pqApplicationCore::instance();
  const QSignalBlocker unnoticed(core);
  pqUndoStack* stack = core->getUndoStack();
  core->setUndoStack(nullptr);
  view->GetSessionProxyManager()->UnRegisterLink(name.c_str());
  core->setUndoStack(stack);
  cameras->RemoveAllLinks(); // else it would keep its views
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
  vtkNew<vtkSMCameraLink> cameras;
  link(cameras, name, first, second);

  // Later steps of the undo stack know this very link by its number, so that it is kept.
  const vtkSmartPointer<vtkSMCameraLink> kept = cameras.GetPointer();
  const ProxyById one(first);
  const ProxyById other(second);
  addUndoStep(
    [kept, name, one]()
    {
      if (one.get())
      {
        unlink(kept, name, one.get());
      }
    },
    [kept, name, one, other]()
    {
      if (one.get() && other.get())
      {
        link(kept, name, one.get(), other.get());
      }
    });
}
