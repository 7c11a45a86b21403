// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImagesInViews.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqRenderView.h"
#include "pqRepresentationRefiner.h"
#include "pqServerManagerModel.h"

#include "vtkPVRenderView.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewLayoutProxy.h"

#include <QSet>
#include <QWidget>

#include <algorithm>
#include <cstring>

namespace
{

pqServerManagerModel* model() { return pqApplicationCore::instance()->getServerManagerModel(); }

/// Adds the views of a source and of all that is made from it.
void addViews(
  pqPipelineSource* source, QSet<pqPipelineSource*>& seen, QList<QPointer<pqView>>& views)
{
  if (seen.contains(source))
  {
    return;
  }
  seen.insert(source);
  for (pqOutputPort* port : source->getOutputPorts())
  {
    for (pqDataRepresentation* representation : port->getRepresentations(nullptr))
    {
      pqView* view = representation->isVisible() ? representation->getView() : nullptr;
      if (view && view->widget() && view->widget()->isVisible() && !views.contains(view))
      {
        views << view;
      }
    }
  }
  for (pqPipelineSource* consumer : source->getAllConsumers())
  {
    addViews(consumer, seen, views);
  }
}

} // namespace

//------------------------------------------------------------------------------
bool imagesInViews::isSchlieren(pqPipelineSource* source)
{
  const char* name = source && source->getProxy() ? source->getProxy()->GetXMLName() : nullptr;
  return name && std::strcmp(name, "Schlieren") == 0 &&
    source->getProxy()->GetProperty("PictureCount");
}

//------------------------------------------------------------------------------
pqPipelineSource* imagesInViews::filterOf(pqPipelineSource* source)
{
  if (!source || isSchlieren(source))
  {
    return source;
  }
  auto* filter = qobject_cast<pqPipelineFilter*>(source);
  for (pqOutputPort* input : filter ? filter->getAllInputs() : QList<pqOutputPort*>())
  {
    if (pqPipelineSource* found = filterOf(input->getSource()))
    {
      return found;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
pqRenderView* imagesInViews::scene(pqOutputPort* flow)
{
  QList<pqRenderView*> views = model()->findItems<pqRenderView*>(flow->getServer());
  auto* active = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  if (active && views.removeOne(active))
  {
    views.prepend(active);
  }
  std::stable_partition(views.begin(), views.end(),
    [flow](pqRenderView* view)
    {
      pqDataRepresentation* shown = flow->getRepresentation(view);
      return pqRepresentationRefiner::benchesIn(view).empty() ||
        (shown && pqRepresentationRefiner::isSchlieren(shown));
    });
  vtkSMViewLayoutProxy* layout = pqActiveObjects::instance().activeLayout();
  const auto isMeant = [active, layout](pqRenderView* view)
  {
    return imagesIn(view).empty() &&
      (view == active || (layout && layout->ContainsView(view->getProxy())));
  };
  const auto found = std::find_if(views.begin(), views.end(), isMeant);
  return found == views.end() ? nullptr : *found;
}

//------------------------------------------------------------------------------
QList<pqPipelineSource*> imagesInViews::filters()
{
  QList<pqPipelineSource*> sources = model()->findItems<pqPipelineSource*>();
  sources.erase(std::remove_if(sources.begin(), sources.end(),
                  [](pqPipelineSource* source) { return !isSchlieren(source); }),
    sources.end());
  return sources;
}

//------------------------------------------------------------------------------
QList<QPointer<pqView>> imagesInViews::showing(pqPipelineSource* filter)
{
  QSet<pqPipelineSource*> seen;
  QList<QPointer<pqView>> views;
  addViews(filter, seen, views);
  return views;
}

//------------------------------------------------------------------------------
QList<pqPipelineSource*> imagesInViews::imagesIn(pqView* view)
{
  QList<pqPipelineSource*> shown;
  for (pqRepresentation* item : view->getRepresentations())
  {
    auto* representation = qobject_cast<pqDataRepresentation*>(item);
    pqOutputPort* port = representation && representation->isVisible()
      ? representation->getOutputPortFromInput()
      : nullptr;
    if (port && port->getPortNumber() == 0 && isSchlieren(port->getSource()) &&
      !shown.contains(port->getSource()))
    {
      shown << port->getSource();
    }
  }
  return shown;
}

//------------------------------------------------------------------------------
bool imagesInViews::isFlat(pqView* view)
{
  return vtkSMPropertyHelper(view->getProxy(), "InteractionMode", true).GetAsInt() ==
    vtkPVRenderView::INTERACTION_MODE_2D;
}
