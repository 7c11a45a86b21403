// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqApplyHooks.h"

#include "ImagesInViews.h"
#include "SchlierenViews.h"

#include "pqApplicationCore.h"
#include "pqApplyBehavior.h"
#include "pqCoreUtilities.h"
#include "pqPipelineSource.h"
#include "pqPropertiesPanel.h"
#include "pqProxyModifiedStateUndoElement.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "pqView.h"
#include "vtkNew.h"
#include "vtkSMViewProxy.h"

#include <QWidget>

#include <algorithm>

//------------------------------------------------------------------------------
pqApplyHooks::pqApplyHooks(QObject* parentObject)
  : QObject(parentObject)
{
}

//------------------------------------------------------------------------------
void pqApplyHooks::setUp()
{
  QWidget* window = pqCoreUtilities::mainWidget();
  if (this->IsSetUp || !window)
  {
    return;
  }
  this->IsSetUp = true;
  const auto oneApplied = QOverload<pqProxy*>::of(&pqPropertiesPanel::applied);
  const auto allApplied = QOverload<>::of(&pqPropertiesPanel::applied);
  for (pqApplyBehavior* behavior : window->findChildren<pqApplyBehavior*>())
  {
    for (pqPropertiesPanel* panel : window->findChildren<pqPropertiesPanel*>())
    {
      // Reconnects ParaView's slot between ours: slots run in the order of connection.
      if (!QObject::disconnect(panel, nullptr, behavior, nullptr))
      {
        continue;
      }
      behavior->unregisterPanel(panel);
      QObject::connect(panel, oneApplied, this, &pqApplyHooks::beforeOne);
      QObject::connect(panel, allApplied, this, &pqApplyHooks::beforeAll);
      behavior->registerPanel(panel);
      QObject::connect(panel, oneApplied, this, &pqApplyHooks::after);
      QObject::connect(panel, allApplied, this, &pqApplyHooks::after);
    }
  }
}

//------------------------------------------------------------------------------
void pqApplyHooks::beforeOne(pqProxy* proxy)
{
  // Precedes ParaView, which shows new sources.
  auto* source = qobject_cast<pqPipelineSource*>(proxy);
  if (!source || source->modifiedState() != pqProxy::UNINITIALIZED)
  {
    return;
  }
  this->Shortly.emplace();
  if (imagesInViews::isSchlieren(source))
  {
    SchlierenViews::show(source);
    // Marks the source as shown, so that ParaView does not show it again.
    vtkNew<pqProxyModifiedStateUndoElement> shown;
    shown->SetSession(source->getServer()->session());
    shown->MadeUnmodified(source);
    ADD_UNDO_ELEM(shown);
    source->setModifiedState(pqProxy::UNMODIFIED);
  }
}

//------------------------------------------------------------------------------
void pqApplyHooks::beforeAll()
{
  // Precedes ParaView, which updates such views.
  const QList<pqView*> views =
    pqApplicationCore::instance()->getServerManagerModel()->findItems<pqView*>();
  if (std::any_of(views.begin(), views.end(),
        [](pqView* view) { return view->getViewProxy()->GetNeedsUpdate(); }))
  {
    this->Shortly.emplace();
  }
}

//------------------------------------------------------------------------------
void pqApplyHooks::after() { this->Shortly.reset(); }
