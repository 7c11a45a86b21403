// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PicturesInViews.h"

#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"

#include "vtkPVRenderView.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewLayoutProxy.h"
#include "vtkSMViewProxy.h"

#include <QSet>
#include <QWidget>

#include <algorithm>
#include <cstring>

namespace
{

pqServerManagerModel* model() { return pqApplicationCore::instance()->getServerManagerModel(); }

/// Adds the views of a source and of all that is made from it.
void addViews(pqPipelineSource* source, QSet<pqPipelineSource*>& seen, QList<pqView*>& views)
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
bool picturesInViews::isSchlieren(pqPipelineSource* source)
{
  const char* name = source && source->getProxy() ? source->getProxy()->GetXMLName() : nullptr;
  return name && std::strcmp(name, "Schlieren") == 0 &&
    source->getProxy()->GetProperty("FollowedView");
}

//------------------------------------------------------------------------------
QList<pqPipelineSource*> picturesInViews::filters()
{
  QList<pqPipelineSource*> sources = model()->findItems<pqPipelineSource*>();
  sources.erase(std::remove_if(sources.begin(), sources.end(),
                  [](pqPipelineSource* source) { return !isSchlieren(source); }),
    sources.end());
  return sources;
}

//------------------------------------------------------------------------------
QList<pqView*> picturesInViews::showing(pqPipelineSource* filter)
{
  QSet<pqPipelineSource*> seen;
  QList<pqView*> views;
  addViews(filter, seen, views);
  return views;
}

//------------------------------------------------------------------------------
QList<pqPipelineSource*> picturesInViews::picturesIn(pqView* view)
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
bool picturesInViews::isFlat(pqView* view)
{
  return vtkSMPropertyHelper(view->getProxy(), "InteractionMode", true).GetAsInt() ==
    vtkPVRenderView::INTERACTION_MODE_2D;
}

//------------------------------------------------------------------------------
QString picturesInViews::followedName(pqPipelineSource* filter)
{
  return QString::fromUtf8(vtkSMPropertyHelper(filter->getProxy(), "FollowedView").GetAsString());
}

//------------------------------------------------------------------------------
pqRenderView* picturesInViews::followed(pqPipelineSource* filter)
{
  const QString name = followedName(filter);
  if (name.isEmpty())
  {
    return nullptr;
  }
  const QList<pqView*> shown = showing(filter);
  pqRenderView* found = nullptr;
  for (pqRenderView* view : model()->findItems<pqRenderView*>(filter->getServer()))
  {
    // A flat view of the picture itself would be moved by what it moves.
    if (view->getSMName() != name || (isFlat(view) && shown.contains(view)))
    {
      continue;
    }
    auto* layout = vtkSMViewLayoutProxy::FindLayout(view->getViewProxy());
    const auto isBeside = [layout](pqView* other)
    { return vtkSMViewLayoutProxy::FindLayout(other->getViewProxy()) == layout; };
    if (std::any_of(shown.begin(), shown.end(), isBeside))
    {
      return view;
    }
    found = found ? found : view;
  }
  return found;
}
