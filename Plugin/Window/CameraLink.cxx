// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "CameraLink.h"

#include "UndoStep.h"

#include "pqApplicationCore.h"
#include "pqLinksModel.h"
#include "pqRenderView.h"
#include "vtkSMProxy.h"

#include <QString>

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
  // A link that outlived its views would keep them.
  addUndoStep([links, name]() { links->removeLink(name); },
    [links, name, one = ProxyById(first->getProxy()), other = ProxyById(second->getProxy())]()
    {
      if (one.get() && other.get())
      {
        links->addCameraLink(name, one.get(), other.get());
      }
    });
}
