// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SchlierenFilters.h"

#include "CameraOfView.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqRepresentation.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMViewLayoutProxy.h"

#include <cstring>

//------------------------------------------------------------------------------
bool isSchlierenFilter(vtkSMProxy* proxy)
{
  return proxy && std::strcmp(proxy->GetXMLGroup(), "filters") == 0 &&
    std::strcmp(proxy->GetXMLName(), "Schlieren") == 0;
}

//------------------------------------------------------------------------------
pqPipelineSource* schlierenFilterOf(pqPipelineSource* source)
{
  if (!source || isSchlierenFilter(source->getProxy()))
  {
    return source;
  }
  if (auto* filter = qobject_cast<pqPipelineFilter*>(source))
  {
    for (pqOutputPort* input : filter->getAllInputs())
    {
      if (pqPipelineSource* found = schlierenFilterOf(input->getSource()))
      {
        return found;
      }
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
pqPipelineSource* pictureIn(pqView* view)
{
  for (pqRepresentation* representation :
    view ? view->getRepresentations() : QList<pqRepresentation*>())
  {
    auto* data = qobject_cast<pqDataRepresentation*>(representation);
    if (data && data->isVisible() && data->getInput() &&
      isSchlierenFilter(data->getInput()->getProxy()))
    {
      return data->getInput();
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
pqRenderView* followedView(vtkSMProxy* filter)
{
  const QString name = vtkSMPropertyHelper(filter, "FollowedView").GetAsString();
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqRenderView* view :
    model->findItems<pqRenderView*>(model->findServer(filter->GetSession())))
  {
    if (!name.isEmpty() && view->getSMName() == name)
    {
      return view;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
pqRenderView* sceneView(pqServer* server)
{
  pqView* active = pqActiveObjects::instance().activeView();
  auto* scene = qobject_cast<pqRenderView*>(active);
  if (scene && scene->getServer() == server)
  {
    pqPipelineSource* picture = pictureIn(scene);
    if (!picture)
    {
      return scene;
    }
    if (pqRenderView* followed = followedView(picture->getProxy()))
    {
      return followed;
    }
  }
  vtkSMViewLayoutProxy* layout = pqActiveObjects::instance().activeLayout();
  for (pqRenderView* view :
    pqApplicationCore::instance()->getServerManagerModel()->findItems<pqRenderView*>(server))
  {
    if (layout && layout->ContainsView(view->getProxy()) && !pictureIn(view))
    {
      return view;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
void follow(vtkSMProxy* filter, pqRenderView* view)
{
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter);
  const QByteArray name = view ? view->getSMName().toUtf8() : QByteArray();
  vtkSMPropertyHelper(filter, "FollowedView").Set(name.constData());
  if (view)
  {
    takeCameraOfView(filter, view->getRenderViewProxy());
  }
  filter->UpdateVTKObjects();
}
