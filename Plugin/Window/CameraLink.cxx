// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "CameraLink.h"

#include "pqApplicationCore.h"
#include "pqLinksModel.h"
#include "pqRenderView.h"
#include "pqUndoStack.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSMProxy.h"
#include "vtkSMSession.h"
#include "vtkSMUndoElement.h"

#include <QString>

namespace
{

/// ParaView does not undo links. A link that outlived its views would keep them.
class LinkUndoElement : public vtkSMUndoElement
{
public:
  static LinkUndoElement* New();
  vtkTypeMacro(LinkUndoElement, vtkSMUndoElement);

  void setLink(const QString& name, vtkSMProxy* first, vtkSMProxy* second)
  {
    this->Name = name;
    this->First = first->GetGlobalID();
    this->Second = second->GetGlobalID();
    this->SetSession(first->GetSession());
  }

  int Undo() override
  {
    pqApplicationCore::instance()->getLinksModel()->removeLink(this->Name);
    return 1;
  }

  int Redo() override
  {
    auto* first = vtkSMProxy::SafeDownCast(this->Session->GetRemoteObject(this->First));
    auto* second = vtkSMProxy::SafeDownCast(this->Session->GetRemoteObject(this->Second));
    if (first && second)
    {
      pqApplicationCore::instance()->getLinksModel()->addCameraLink(this->Name, first, second);
    }
    return 1;
  }

protected:
  LinkUndoElement() = default;
  ~LinkUndoElement() override = default;

private:
  QString Name;
  vtkTypeUInt32 First = 0;
  vtkTypeUInt32 Second = 0;
};

vtkStandardNewMacro(LinkUndoElement);

} // namespace

//------------------------------------------------------------------------------
void linkCameras(pqRenderView* first, pqRenderView* second)
{
  pqLinksModel* links = pqApplicationCore::instance()->getLinksModel();
  QString name;
  int number = 1;
  do
  {
    name = QString("SchlierenPictures%1").arg(number++);
  } while (links->getLink(name));
  links->addCameraLink(name, first->getProxy(), second->getProxy());
  vtkNew<LinkUndoElement> element;
  element->setLink(name, first->getProxy(), second->getProxy());
  ADD_UNDO_ELEM(element);
}
