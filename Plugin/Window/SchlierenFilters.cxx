// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SchlierenFilters.h"

#include "PicturesInViews.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "vtkSMProxy.h"
#include "vtkSMViewLayoutProxy.h"

//------------------------------------------------------------------------------
pqPipelineSource* schlierenFilterOf(pqPipelineSource* source)
{
  if (!source || picturesInViews::isSchlieren(source))
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
pqRenderView* sceneView(pqServer* server)
{
  pqView* active = pqActiveObjects::instance().activeView();
  auto* scene = qobject_cast<pqRenderView*>(active);
  if (scene && scene->getServer() == server && picturesInViews::picturesIn(scene).empty())
  {
    return scene;
  }
  vtkSMViewLayoutProxy* layout = pqActiveObjects::instance().activeLayout();
  for (pqRenderView* view :
    pqApplicationCore::instance()->getServerManagerModel()->findItems<pqRenderView*>(server))
  {
    if (layout && layout->ContainsView(view->getProxy()) &&
      picturesInViews::picturesIn(view).empty())
    {
      return view;
    }
  }
  return nullptr;
}
